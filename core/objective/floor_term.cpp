#include "core/objective/floor_term.h"

namespace mocap {
namespace {

/// How deep the lowest place at an end of a capsule is below the floor; above it negative.
double DepthBelowFloor(const PosedCapsule& capsule, double share) {
  return RadiusAt(capsule, share) - (share == 0 ? capsule.a_W : capsule.b_W).z();
}

}  // namespace

// The ends of a foot are below the floor together; they are no more evidence than one.
std::array<LowestEnd, kBodyPartCount> EndsBelowFloor(const PosedBody& posed, CapsuleSet capsules) {
  std::array<LowestEnd, kBodyPartCount> lowest;
  for (int i = 0; i < std::ssize(posed.capsules()); ++i) {
    if (!(capsules >> i & 1)) continue;
    const PosedCapsule& capsule = posed.capsules()[i];
    LowestEnd& end = lowest[static_cast<int>(posed.body().shape()[i].part)];
    for (const double share : {0.0, 1.0}) {
      const double depth_mm = DepthBelowFloor(capsule, share);
      if (depth_mm > end.depth_mm) end = {i, share == 0 ? capsule.a_W : capsule.b_W, depth_mm};
    }
  }
  return lowest;
}

double FloorTerm::At(const PosedBody& posed, CapsuleSet capsules) const {
  LogSum sum;
  for (const LowestEnd& end : EndsBelowFloor(posed, capsules))
    if (end.capsule >= 0) sum.Add(noise_.ScaledSquare(end.depth_mm));
  return noise_.NatsOf(sum.Sum());
}

void FloorTerm::Linearize(const PosedBody& posed, CapsuleSet capsules, Linearisation& sums) const {
  for (const LowestEnd& end : EndsBelowFloor(posed, capsules)) {
    if (end.capsule < 0) continue;
    sums.chain.Add(posed.CarrierOf(end.capsule), end.middle_W, Vector3::UnitZ(), end.depth_mm,
                   noise_.VarianceAt(end.depth_mm));
  }
}

}  // namespace mocap
