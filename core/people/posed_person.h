// Beyond the paper: one of several people, at the predicted pose.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/motion_capture.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Evidence closer than this to a predicted body may be its own. Evidence farther from all bodies
/// may belong to a lost limb.
inline constexpr double kExplainsMm = 80;

/// Flesh this close to a predicted body may be its own.
inline constexpr double kReachMm = 220;

/// A carved-away limb may be this far from its prediction or from the flesh.
inline constexpr double kAsideMm = 100;

/// A predicted body in a frame, for comparison with the evidence.
struct PosedPerson {
  std::vector<PosedCapsule> capsules;
  Eigen::AlignedBox3d box_W;  ///< Around the capsules and everything they may explain [mm].
  double reach_mm = 0;        ///< Flesh farther than this from every capsule is not the person's.
  bool is_lost = false;       ///< The person may be elsewhere.
};

/// Sets the capsules for a body and a pose; reuses the memory of `person`.
void PosePerson(const BodyModel& body, const PoseState& pose, double reach_mm, PosedPerson& person);

/// Returns the distance of a point from a body, at most the person's reach.
/// @param enough_mm  any distance below this will do.
double DistanceTo(const PosedPerson& person, const Vector3& p_W, double enough_mm);

/// Returns a room's flesh with the doubtful cells that are within the bodies of people who are not
/// lost. Where there are none, that is the room's own.
/// @param believed  memory for the result.
const VoxelGrid& BelieveWithin(std::span<const PosedPerson> people, const Observation& room,
                               VoxelGrid& believed);

/// Returns a box around flesh, with a margin and down to the floor: legs may have been carved away.
Eigen::AlignedBox3d DownToFloor(const Eigen::AlignedBox3d& flesh_W, double beside_mm);

/// Returns a box around a whole stranger, given the remaining flesh: wider by the reach of limbs
/// that may have been carved away, and by a stride where legs were.
Eigen::AlignedBox3d AroundStranger(const Eigen::AlignedBox3d& flesh_W);

}  // namespace mocap
