#include "core/objective/floor_term.h"

namespace mocap {
namespace {

// Visits the ends that are below the floor: capsule, middle of the end, depth.
template <typename Visit>
void ForEachBelow(const PosedBody& posed, CapsuleSet capsules, const Visit& visit) {
  for (int i = 0; i < std::ssize(posed.capsules()); ++i) {
    if (!(capsules >> i & 1)) continue;
    const PosedCapsule& capsule = posed.capsules()[i];
    for (const double share : {0.0, 1.0}) {
      const double depth_mm = DepthBelowFloor(capsule, share);
      if (depth_mm > 0) visit(i, share == 0 ? capsule.a_W : capsule.b_W, depth_mm);
    }
  }
}

}  // namespace

double FloorTerm::At(const PosedBody& posed, CapsuleSet capsules) const {
  LogSum sum;
  ForEachBelow(posed, capsules, [&](int, const Vector3&, double depth_mm) {
    sum.Add(kFloorNoise.ScaledSquare(depth_mm));
  });
  return kFloorNoise.NatsOf(sum.Sum());
}

void FloorTerm::Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const {
  ForEachBelow(posed, capsules, [&](int i, const Vector3& p_W, double depth_mm) {
    sums.chain.Add(posed.CarrierOf(i), p_W, Vector3::UnitZ(), depth_mm,
                   kFloorNoise.VarianceAt(depth_mm));
  });
}

}  // namespace mocap
