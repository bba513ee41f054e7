// Beyond the paper: one of several people, at the predicted pose.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Evidence closer than this to a predicted body may be its own. Evidence farther from all bodies
/// may belong to a lost limb.
inline constexpr double kExplainsMm = 80;

/// A predicted body in a frame, for comparison with the evidence.
struct PosedPerson {
  std::vector<PosedCapsule> capsules;
  Eigen::AlignedBox3d box_W;  ///< Around the capsules and everything they may explain [mm].
  double reach_mm = 0;        ///< Flesh farther than this from every capsule is not the person's.
  /// Added to the distances of a person whose position is uncertain, so that others come first.
  double handicap_mm = 0;
};

/// Sets the capsules for a body and a pose; reuses the memory of `person`.
void PosePerson(const BodyModel& body, const PoseState& pose, double reach_mm, double handicap_mm,
                PosedPerson& person);

/// Sets those cells of a grid whose centres are within the body.
void AddCellsWithin(const PosedPerson& person, std::span<const Eigen::Vector3i> cells,
                    VoxelGrid& flesh);

/// Returns a box around flesh, with a margin and down to the floor: legs may have been carved away.
Eigen::AlignedBox3d DownToFloor(const Eigen::AlignedBox3d& flesh_W, double beside_mm);

/// Returns a box around a whole stranger, given the remaining flesh: wider by the reach of limbs
/// that may have been carved away, and by a stride where legs were.
Eigen::AlignedBox3d AroundStranger(const Eigen::AlignedBox3d& flesh_W);

}  // namespace mocap
