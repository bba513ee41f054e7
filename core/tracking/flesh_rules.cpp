#include "core/tracking/flesh_rules.h"

#include <limits>

namespace mocap {
namespace {

// Flesh gives way, the capsules are rounder than the parts, and what lies on somebody stout sinks
// in the deeper: as shares of the limb's and the other part's radius.
constexpr double kHolds = 0.5;
constexpr double kGivesWay = 0.5;

bool IsLowerArm(BodyPart part) {
  return part == BodyPart::kLowerArmL || part == BodyPart::kLowerArmR;
}
bool IsThigh(BodyPart part) { return part == BodyPart::kThighL || part == BodyPart::kThighR; }
bool IsCalf(BodyPart part) { return part == BodyPart::kCalfL || part == BodyPart::kCalfR; }

}  // namespace

bool MayOverlap(BodyPart limb, BodyPart other) {
  if (limb == other) return false;
  if (IsLowerArm(limb)) {
    return other == BodyPart::kTorso || other == BodyPart::kHead || IsThigh(other) ||
           IsLowerArm(other);
  }
  const BodyPart own_thigh = limb == BodyPart::kCalfL ? BodyPart::kThighL : BodyPart::kThighR;
  return IsCalf(limb) && (IsCalf(other) || (IsThigh(other) && other != own_thigh));
}

std::optional<Vector3> WayToFlesh(const VoxelCloud& cloud, std::span<const Vector3> surface_W,
                                  const Vector3& p_W) {
  if (cloud.Holds(p_W)) return std::nullopt;
  std::optional<Vector3> nearest;
  double nearest_sq = std::numeric_limits<double>::infinity();
  for (const Vector3& place_W : surface_W) {
    const double distance_sq = (place_W - p_W).squaredNorm();
    if (distance_sq >= nearest_sq) continue;
    nearest_sq = distance_sq;
    nearest = place_W - p_W;
  }
  return nearest;
}

bool CanStickIn(const PosedCapsule& limb, const Vector3& p_W, const PosedCapsule& other) {
  const double reach_mm = other.reach_mm + kHolds * limb.radius_a_mm;
  return (p_W - other.middle_W).squaredNorm() < reach_mm * reach_mm;
}

double OverlapDepth(const PosedCapsule& limb, const PosedCapsule& other,
                    const PosedCapsule::Distance& to_other) {
  return kHolds * limb.radius_a_mm - kGivesWay * RadiusAt(other, to_other.share) -
         to_other.outside_mm;
}

}  // namespace mocap
