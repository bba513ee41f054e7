#include "core/objective/flesh_term.h"

#include <algorithm>

namespace mocap {
namespace {

constexpr double kLeastWhole = 0.1;

}  // namespace

void FleshTerm::SetEvidence(const Evidence& evidence, std::span<const Contact> contacts,
                            double pose_std_mm) {
  cloud_ = &evidence.cloud;
  surface_W_.Clear();
  for (const Contact& contact : contacts)
    if (!contact.is_edge)
      surface_W_.Add({contact.from_W.x(), contact.from_W.y(), contact.from_W.z()});
  // A hull with holes says less.
  noise_ = kFleshNoise.Widened(pose_std_mm);
  noise_.alike /= std::max(kLeastWhole, 1 - evidence.MissingShare());
}

std::optional<Vector3> FleshTerm::WayToFlesh(const Vector3& p_W) const {
  if (surface_W_.empty() || cloud_->IsFlesh(p_W)) return std::nullopt;
  const std::array<double, 3> nearest_W = surface_W_.To({p_W.x(), p_W.y(), p_W.z()});
  return Eigen::Map<const Vector3>(nearest_W.data()) - p_W;
}

template <typename Visit>
void FleshTerm::ForEach(const PosedBody& posed, CapsuleSet capsules, const Visit& visit) const {
  for (int i = 0; i < std::ssize(posed.capsules()); ++i) {
    if (!(capsules >> i & 1)) continue;
    for (const double share : kCoreShares) {
      const Vector3 p_W = CorePlace(posed.capsules()[i], share);
      if (const auto way_W = WayToFlesh(p_W)) visit(i, p_W, *way_W);
    }
  }
}

double FleshTerm::At(const PosedBody& posed, CapsuleSet capsules) const {
  LogSum sum;
  ForEach(posed, capsules, [&](int, const Vector3&, const Vector3& way_W) {
    sum.Add(noise_.ScaledSquare(std::min(way_W.norm(), kReach_mm)));
  });
  return noise_.NatsOf(sum.Sum());
}

void FleshTerm::Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const {
  ForEach(posed, capsules, [&](int i, const Vector3& p_W, const Vector3& way_W) {
    const double distance_mm = way_W.norm();
    if (distance_mm > kReach_mm) return;
    sums.chain.AddPoint(posed.CarrierOf(i), p_W, way_W, noise_.VarianceAt(distance_mm));
  });
}

}  // namespace mocap
