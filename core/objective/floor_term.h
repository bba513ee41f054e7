// Nobody is below the floor, z = 0.
#pragma once

#include <array>

#include "core/body/posed_body.h"
#include "core/objective/noise.h"

namespace mocap {

/// The lowest end of a part of the body.
struct LowestEnd {
  int capsule = -1;  ///< -1: the part is above the floor.
  Vector3 middle_W = Vector3::Zero();
  double depth_mm = 0;  ///< How deep its flesh is below the floor.
};

/// Finds the lowest end of each part among these capsules, by BodyPart.
std::array<LowestEnd, kBodyPartCount> EndsBelowFloor(const PosedBody& posed, CapsuleSet capsules);

/// -log p of flesh below the floor: the residual is the depth of the lowest end of each part.
class FloorTerm {
 public:
  /// @param pose_std_mm  how far poses may be off.
  explicit FloorTerm(double pose_std_mm = 0) : noise_(kFloorNoise.Widened(pose_std_mm)) {}

  double At(const PosedBody& posed, CapsuleSet capsules) const;
  void Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const;

 private:
  ResidualNoise noise_;
};

}  // namespace mocap
