#include "core/body/body_shape.h"

#include <gtest/gtest.h>

#include <random>

namespace mocap {
namespace {

class RandomCapsules : public testing::Test {
 protected:
  Vector3 Place() { return 300 * Vector3(unit_(random_), unit_(random_), unit_(random_)); }
  PosedCapsule Capsule() {
    return {Place(), Place(), 40 + 20 * unit_(random_), 40 + 20 * unit_(random_)};
  }

  std::mt19937 random_{11};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

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
