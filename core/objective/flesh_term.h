// Bones lie in flesh.
#pragma once

#include <optional>
#include <span>

#include "core/body/posed_body.h"
#include "core/evidence/contact.h"
#include "core/kernels/nearest.h"
#include "core/objective/noise.h"

namespace mocap {

/// -log p of the places along each capsule's core: the residual is the distance from the
/// nearest surface voxel that is looked at, or 0 in flesh. A whole hull contains the body, so the
/// bones of a right pose are hardly ever outside. With less weight, a large body with bent limbs
/// would explain the clothes of a small one. A hull with holes says less.
class FleshTerm {
 public:
  /// @param contacts  those that the pose is compared with; `evidence` is borrowed until the next
  /// call.
  void SetEvidence(const Evidence& evidence, std::span<const Contact> contacts, double pose_std_mm);
  double At(const PosedBody& posed, CapsuleSet capsules) const;
  void Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const;

  /// Vector from a point in the void to the nearest of the evidence's surface voxels; empty for a
  /// point in flesh.
  std::optional<Vector3> WayToFlesh(const Vector3& p_W) const;

 private:
  template <typename Visit>
  void ForEach(const PosedBody& posed, CapsuleSet capsules, const Visit& visit) const;

  const VoxelCloud* cloud_ = nullptr;
  kernels::NearestPoint surface_W_;
  ResidualNoise noise_ = kFleshNoise;
};

}  // namespace mocap
