#include "core/tracking/flesh_rules.h"

#include <limits>

#include "core/kernels/nearest.h"

namespace mocap {
namespace {

// Flesh yields, capsules are rounder than parts, and limbs sink deeper into a stout person. As
// shares of the limb's and the other part's radius.
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

void PlaceColumns::Set(std::span<const Contact> contacts) {
  for (std::vector<double>& axis : axes_) axis.clear();
  for (const Contact& contact : contacts) {
    if (contact.is_edge) continue;
    for (int axis = 0; axis < 3; ++axis) axes_[axis].push_back(contact.from_W[axis]);
  }
  size_ = static_cast<int>(axes_[0].size());
  const auto whole = static_cast<std::size_t>((size_ + kernels::kPointStep - 1) /
                                              kernels::kPointStep * kernels::kPointStep);
  for (std::vector<double>& axis : axes_)
    axis.resize(whole, std::numeric_limits<double>::infinity());
}

Vector3 PlaceColumns::NearestTo(const Vector3& p_W) const {
  const int i = kernels::FindNearestPoint(axes_[0].data(), axes_[1].data(), axes_[2].data(), size_,
                                          {p_W.x(), p_W.y(), p_W.z()});
  return {axes_[0][i], axes_[1][i], axes_[2][i]};
}

std::optional<Vector3> WayToFlesh(const VoxelCloud& cloud, const PlaceColumns& surface_W,
                                  const Vector3& p_W) {
  if (surface_W.size() == 0 || cloud.IsFlesh(p_W)) return std::nullopt;
  return surface_W.NearestTo(p_W) - p_W;
}

bool CanStickIn(const PosedCapsule& limb, const Vector3& p_W, const PosedCapsule& other) {
  const double reach_mm = other.reach_mm + kHolds * limb.radius_a_mm;
  return (p_W - other.middle_W).squaredNorm() < reach_mm * reach_mm;
}

double OverlapDepth(const PosedCapsule& limb, const PosedCapsule& other,
                    const PosedCapsule::Distance& to_other) {
  const double outside_mm = to_other.outside_mm + other.ClothAt(to_other.share);
  return kHolds * RadiusAt(limb, 0) - kGivesWay * RadiusAt(other, to_other.share) - outside_mm;
}

}  // namespace mocap
