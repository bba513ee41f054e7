#include "tests/support/random_capsules.h"

namespace mocap {
namespace {

TEST_F(RandomCapsules, SegmentsAreAsFarAsTheirNearestPlace) {
  for (int trial = 0; trial < 50; ++trial) {
    const PosedCapsule capsule = Capsule();
    const Vector3 from = Place();
    const Vector3 to = Place();
    double nearest_mm = 1e9;
    for (int i = 0; i <= 1000; ++i) {
      const Vector3 p = from + i / 1000.0 * (to - from);
      nearest_mm = std::min(nearest_mm, capsule.DistanceTo(p).outside_mm);
    }
    const PosedCapsule::SegmentDistance distance = capsule.DistanceTo(from, to);
    EXPECT_NEAR(distance.outside_mm, nearest_mm, 2);
    EXPECT_NEAR(distance.outside_mm, capsule.DistanceTo(distance.segment_W).outside_mm, 1e-6);
  }
}

}  // namespace
}  // namespace mocap
