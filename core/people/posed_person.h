// Beyond the paper: a person among others, where he is expected to be.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/body/body_model.h"

namespace mocap {

/// What is nearer than this to a body, as it is expected, may be its own; what is farther from all
/// bodies may be of a limb that was lost.
inline constexpr double kExplainsMm = 80;

/// A body as it is expected in a frame, to hold the evidence of a room against.
struct PosedPerson {
  std::vector<PosedCapsule> capsules;
  Eigen::AlignedBox3d box_W;  ///< Around the capsules and all that they may explain [mm].
  double reach_mm = 0;        ///< Flesh that is farther from every capsule is not the person's.
  /// Added to the distances of somebody whose place is not known well, so that others come first.
  double handicap_mm = 0;
};

/// Puts a body where a pose has it; keeps the memory of `person`.
void PosePerson(const BodyModel& body, const PoseState& pose, double reach_mm, double handicap_mm,
                PosedPerson& person);

/// A box around flesh and as much beside it, down to the floor: legs may have been carved away.
Eigen::AlignedBox3d DownToFloor(const Eigen::AlignedBox3d& flesh_W, double beside_mm);

/// Where all of a stranger is, by the flesh that is left: as far beside it as limbs may have been
/// carved away, and a stride where the legs were.
Eigen::AlignedBox3d AroundStranger(const Eigen::AlignedBox3d& flesh_W);

}  // namespace mocap
