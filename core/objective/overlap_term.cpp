#include "core/objective/overlap_term.h"

namespace mocap {
namespace {

// Flesh yields, capsules are rounder than parts, and limbs sink deeper into a stout person. As a
// share of the limb's and the other part's radius.
constexpr double kHolds = 0.5;

bool IsLowerArm(BodyPart part) {
  return part == BodyPart::kLowerArmL || part == BodyPart::kLowerArmR;
}
bool IsThigh(BodyPart part) { return part == BodyPart::kThighL || part == BodyPart::kThighR; }
bool IsCalf(BodyPart part) { return part == BodyPart::kCalfL || part == BodyPart::kCalfR; }

// False if a point on the core of `limb` is too far from `other` to intersect it.
bool CanStickIn(const PosedCapsule& limb, const Vector3& p_W, const PosedCapsule& other) {
  const double reach_mm = other.reach_mm + kHolds * limb.radius_a_mm;
  return (p_W - other.middle_W).squaredNorm() < reach_mm * reach_mm;
}

// Visits places of limbs in other parts: limb, place, part, distance from it, depth.
template <typename Visit>
void ForEachOverlap(const PosedBody& posed, CapsuleSet limbs, CapsuleSet present,
                    const Visit& visit) {
  const std::vector<PosedCapsule>& capsules = posed.capsules();
  const std::vector<Capsule>& shape = posed.body().shape();
  for (int i = 0; i < std::ssize(capsules); ++i) {
    if (!(limbs >> i & 1)) continue;
    for (int j = 0; j < std::ssize(capsules); ++j) {
      if (!(present >> j & 1) || !MayOverlap(shape[i].part, shape[j].part)) continue;
      for (const double share : kCoreShares) {
        const Vector3 p_W = CorePlace(capsules[i], share);
        if (!CanStickIn(capsules[i], p_W, capsules[j])) continue;
        const PosedCapsule::Distance distance = capsules[j].DistanceTo(p_W);
        const double depth_mm = OverlapDepth(capsules[i], capsules[j], distance);
        if (depth_mm > 0) visit(i, p_W, j, distance, depth_mm);
      }
    }
  }
}

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

double OverlapDepth(const PosedCapsule& limb, const PosedCapsule& other,
                    const PosedCapsule::Distance& to_other) {
  const double outside_mm = to_other.outside_mm + other.ClothAt(to_other.share);
  return kHolds * (RadiusAt(limb, 0) - RadiusAt(other, to_other.share)) - outside_mm;
}

double OverlapTerm::At(const PosedBody& posed, CapsuleSet limbs, CapsuleSet present) const {
  LogSum sum;
  ForEachOverlap(posed, limbs, present,
                 [&](int, const Vector3&, int, const PosedCapsule::Distance&, double depth_mm) {
                   sum.Add(kOverlapNoise.ScaledSquare(depth_mm));
                 });
  return kOverlapNoise.NatsOf(sum.Sum());
}

void OverlapTerm::Linearize(const PosedBody& posed, CapsuleSet limbs, CapsuleSet present,
                            Linearisation& sums) const {
  const BodyModel& body = posed.body();
  PoseStep J_limb(body.dof()), J_other(body.dof());
  ForEachOverlap(
      posed, limbs, present,
      [&](int i, const Vector3& p_W, int j, const PosedCapsule::Distance& distance,
          double depth_mm) {
        const Vector3 offset = p_W - distance.core_W;
        if (offset.norm() < 1) return;
        // The other part is thinner where the place slides along a taper.
        const Vector3 out_W =
            offset.normalized() - kHolds * LeanOf(posed.capsules()[j], distance.share);
        body.DirectionalJacobian(posed.posture(), posed.CarrierOf(i), p_W, out_W, J_limb);
        body.DirectionalJacobian(posed.posture(), posed.CarrierOf(j), p_W, out_W, J_other);
        sums.equations.Add(J_limb - J_other, depth_mm, kOverlapNoise.VarianceAt(depth_mm));
      });
}

}  // namespace mocap
