#include "core/body/segment_matcher.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_capsules.h"

namespace mocap {
namespace {

constexpr double kReachMm = 150;

double MismatchOf(const OrientedSegment& segment, const PosedCapsule& capsule) {
  const PosedCapsule::SegmentDistance distance = capsule.DistanceTo(segment.from_W, segment.to_W);
  const Vector3 offset = distance.segment_W - distance.core_W;
  const double facing = segment.outward_W.dot(offset) / (offset.norm() + 1);
  return std::abs(distance.outside_mm) + 40 * (1 - facing);
}

TEST_F(RandomCapsules, GetTheSegmentsThatTheyMatchBest) {
  std::vector<PosedCapsule> capsules;
  for (int i = 0; i < 12; ++i) capsules.push_back(Capsule());
  std::vector<OrientedSegment> segments;
  for (int i = 0; i < 203; ++i) {
    const Vector3 from = Place();
    segments.push_back({from, i % 3 != 0 ? Place() : from, Place().normalized()});
  }
  SegmentMatcher matcher;
  matcher.SetSegments(segments);
  const std::vector<SegmentMatch>& matches = matcher.Match(capsules, kReachMm);
  ASSERT_EQ(matches.size(), segments.size());
  int matched = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (const PosedCapsule& capsule : capsules) {
      least = std::min(least, MismatchOf(segments[i], capsule));
    }
    // The search leaves out by how little a taper moves the nearest place.
    constexpr double kByTaperMm = 3;
    if (matches[i].capsule < 0) {
      EXPECT_GT(least, kReachMm - kByTaperMm);
      continue;
    }
    ++matched;
    EXPECT_LT(MismatchOf(segments[i], capsules[matches[i].capsule]), least + kByTaperMm);
    EXPECT_NEAR(
        matches[i].distance.outside_mm,
        capsules[matches[i].capsule].DistanceTo(segments[i].from_W, segments[i].to_W).outside_mm,
        1e-6);
  }
  EXPECT_GT(matched, 100);
}

// Whoever was the best before is tried first; another body may have fewer parts.
TEST_F(RandomCapsules, MatchTheSameWhateverWasMatchedBefore) {
  std::vector<OrientedSegment> segments;
  for (int i = 0; i < 203; ++i) segments.push_back({Place(), Place(), Place().normalized()});
  SegmentMatcher used;
  used.SetSegments(segments);
  for (const int count : {12, 5, 1, SegmentMatcher::kMostCapsules}) {
    std::vector<PosedCapsule> capsules;
    for (int i = 0; i < count; ++i) capsules.push_back(Capsule());
    SegmentMatcher fresh;
    fresh.SetSegments(segments);
    const std::vector<SegmentMatch>& again = used.Match(capsules, kReachMm);
    const std::vector<SegmentMatch>& first = fresh.Match(capsules, kReachMm);
    for (std::size_t i = 0; i < segments.size(); ++i) EXPECT_EQ(again[i].capsule, first[i].capsule);
  }
}

TEST(SegmentMatcher, ChoosesTheSideThatFacesTheSegmentsWay) {
  const std::vector<PosedCapsule> legs = {{{0, 80, 0}, {0, 80, 400}, 60, 60},
                                          {{0, -80, 0}, {0, -80, 400}, 60, 60}};
  // Between the legs, a little nearer to the right one, but on the left one's inside.
  const Vector3 place(0, -5, 200);
  const std::vector<OrientedSegment> segments = {{place, place, -Vector3::UnitY()},
                                                 {place, place, Vector3::UnitY()}};
  SegmentMatcher matcher;
  matcher.SetSegments(segments);
  EXPECT_EQ(matcher.Match(legs, kReachMm)[0].capsule, 0);
  EXPECT_EQ(matcher.Match(legs, kReachMm)[1].capsule, 1);
  EXPECT_EQ(matcher.Match(legs, 5)[1].capsule, -1);
}

}  // namespace
}  // namespace mocap
