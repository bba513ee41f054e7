#include "core/body/segment_distances.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/random_capsules.h"

namespace mocap {
namespace {

TEST_F(RandomCapsules, AreAsFarFromManySegmentsAsFromEach) {
  constexpr int kCount = 150;
  std::vector<PosedCapsule> capsules;
  std::vector<Vector3> from, to;
  for (int i = 0; i < kCount; ++i) {
    capsules.push_back(Capsule());
    from.push_back(Place());
    to.push_back(i % 3 == 0 ? from[i] : Place());
    // Beside it, and through it.
    if (i % 7 == 0) to[i] = from[i] + (capsules[i].b_W - capsules[i].a_W);
    if (i % 11 == 0) from[i] = capsules[i].middle_W;
  }
  std::vector<PosedCapsule::SegmentDistance> found(kCount);
  std::vector<CapsuleAndSegment> pairs;
  for (int i = 0; i < kCount; ++i) pairs.push_back({&capsules[i], &from[i], &to[i], &found[i]});
  FindDistances(pairs);
  for (int i = 0; i < kCount; ++i) {
    const PosedCapsule::SegmentDistance expected = capsules[i].DistanceTo(from[i], to[i]);
    EXPECT_NEAR(found[i].outside_mm, expected.outside_mm, 1e-6);
    EXPECT_NEAR(found[i].share, expected.share, 1e-6);
    EXPECT_LT((found[i].core_W - expected.core_W).norm(), 1e-4);
    EXPECT_LT((found[i].segment_W - expected.segment_W).norm(), 1e-4);
  }
}

TEST_F(RandomCapsules, MayHaveNoSegments) { FindDistances({}); }

}  // namespace
}  // namespace mocap
