// Flesh lies within the silhouettes.
//
// A ray is satisfied by the part that explains it best, whatever else extends over it. A ray across
// a protruding hand cuts into the hand and does not show the direction back. The border nearest to
// each part does.
#pragma once

#include <vector>

#include "core/body/posed_body.h"
#include "core/evidence/evidence.h"
#include "core/objective/noise.h"
#include "core/reconstruction/silhouette/protrusion.h"

namespace mocap {

/// -log p of the places along each capsule's core: the residual is how far a ball of flesh there
/// extends beyond the border of a silhouette, negative as for any evidence inside of the flesh.
class BorderTerm {
 public:
  /// Borders say little about poses that are off by more than their noise, and cost half of an
  /// evaluation: they are left out.
  void SetEvidence(const Evidence& evidence, double pose_std_mm);
  double At(const PosedBody& posed, CapsuleSet capsules) const;
  void Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const;

  /// Visits the places that protrude: capsule, share of its core, place, Protrusion.
  template <typename Visit>
  void ForEach(const PosedBody& posed, CapsuleSet capsules, const Visit& visit) const;

  const ResidualNoise& noise() const { return noise_; }

 private:
  std::vector<SilhouetteBorder> borders_;  ///< One per camera.
  ResidualNoise noise_ = kBorderNoise;
};

template <typename Visit>
void BorderTerm::ForEach(const PosedBody& posed, CapsuleSet capsules, const Visit& visit) const {
  for (int i = 0; i < std::ssize(posed.capsules()); ++i) {
    if (!(capsules >> i & 1)) continue;
    const PosedCapsule& capsule = posed.capsules()[i];
    for (std::size_t place = 0; place < kCoreShares.size(); ++place) {
      if (!posed.body().shape()[i].held[place]) continue;
      const double share = kCoreShares[place];
      const Vector3 p_W = CorePlace(capsule, share);
      const double radius_mm = RadiusAt(capsule, share);
      for (const SilhouetteBorder& border : borders_)
        if (const auto protrusion = border.ProtrusionOf(p_W, radius_mm))
          visit(i, share, p_W, *protrusion);
    }
  }
}

}  // namespace mocap
