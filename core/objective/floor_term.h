// Nobody is below the floor, z = 0.
#pragma once

#include "core/body/posed_body.h"
#include "core/objective/noise.h"

namespace mocap {

/// How deep the lowest place at an end of a capsule is below the floor [mm]; above it negative.
inline double DepthBelowFloor(const PosedCapsule& capsule, double share) {
  return RadiusAt(capsule, share) - (share == 0 ? capsule.a_W : capsule.b_W).z();
}

/// -log p of flesh below the floor: the residual is the depth of the lowest place at each end of a
/// capsule.
class FloorTerm {
 public:
  double At(const PosedBody& posed, CapsuleSet capsules) const;
  void Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const;
};

}  // namespace mocap
