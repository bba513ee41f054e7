#include "core/objective/border_term.h"

#include <algorithm>

namespace mocap {

void BorderTerm::SetEvidence(const Evidence& evidence, double pose_std_mm) {
  const bool tell = pose_std_mm <= kBorderNoise.inside_mm;
  noise_ = kBorderNoise.Widened(pose_std_mm);
  const auto cameras =
      evidence.borders.size() - std::ranges::count_if(evidence.borders, &Outline::empty);
  noise_.alike *= static_cast<double>(std::max<std::size_t>(1, cameras));
  borders_.resize(tell ? evidence.borders.size() : 0);
  for (std::size_t i = 0; i < borders_.size(); ++i) borders_[i].SetOutline(evidence.borders[i]);
}

double BorderTerm::At(const PosedBody& posed, CapsuleSet capsules) const {
  LogSum sum;
  ForEach(posed, capsules, [&](int, double, const Vector3&, const Protrusion& protrusion) {
    sum.Add(noise_.ScaledSquare(-protrusion.depth_mm));
  });
  return noise_.NatsOf(sum.Sum());
}

void BorderTerm::Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const {
  ForEach(posed, capsules, [&](int i, double, const Vector3& p_W, const Protrusion& protrusion) {
    sums.chain.Add(posed.CarrierOf(i), p_W, protrusion.outward_W, -protrusion.depth_mm,
                   noise_.VarianceAt(-protrusion.depth_mm));
  });
}

}  // namespace mocap
