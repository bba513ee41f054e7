// A body at a pose: its axes and capsules.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/body/chain_equations.h"

namespace mocap {

/// A set of capsules, a bit for each.
using CapsuleSet = std::uint32_t;

/// A body at a pose. Reuses its memory.
class PosedBody {
 public:
  /// Places all of the body; it is borrowed until the next call.
  void Set(const BodyModel& body, const PoseState& pose);
  /// Moves some joints of the body that was set; all others stay.
  /// @param rows  as for BodyModel::MoveAxes.
  void Move(const PoseState& pose, std::span<const int> rows);

  const BodyModel& body() const { return *body_; }
  const PoseState& pose() const { return pose_; }
  const Posture& posture() const { return posture_; }
  const std::vector<PosedCapsule>& capsules() const { return capsules_; }
  int CarrierOf(int capsule) const { return body_->shape()[capsule].carrier; }

 private:
  const BodyModel* body_ = nullptr;
  PoseState pose_;
  Posture posture_;
  std::vector<PosedCapsule> capsules_;
};

/// Places along the core of each capsule that are compared, as shares of its length.
inline constexpr std::array<double, 3> kCoreShares = {0.0, 0.5, 1.0};

inline Vector3 CorePlace(const PosedCapsule& capsule, double share) {
  return capsule.a_W + share * (capsule.b_W - capsule.a_W);
}
/// Radius of the flesh, without cloth.
inline double RadiusAt(const PosedCapsule& capsule, double share) {
  return capsule.radius_a_mm + share * (capsule.radius_b_mm - capsule.radius_a_mm) -
         capsule.ClothAt(share);
}
/// Change of a tapered capsule's surface as the core slides along itself.
inline Vector3 LeanOf(const PosedCapsule& capsule, double share) {
  if (share <= 0 || share >= 1) return Vector3::Zero();
  const Vector3 core_W = capsule.b_W - capsule.a_W;
  return (capsule.radius_b_mm - capsule.radius_a_mm) / core_W.squaredNorm() * core_W;
}

}  // namespace mocap
