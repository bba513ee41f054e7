#include "tools/comparison/speed_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocap {
namespace {

Signal NoiseOf(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Signal signal;
  for (std::size_t i = 0; i < count; ++i) signal.push_back(static_cast<double>(random() % 1000));
  return signal;
}

TEST(FindOffsets, FindsAPartOfASignalInSpiteOfGaps) {
  const Signal whole = NoiseOf(300, 1);
  Signal part(whole.begin() + 77, whole.begin() + 200);
  for (std::size_t i = 20; i < 40; ++i) part[i] = std::nan("");
  const auto found = FindOffsets({{whole, part}}, 30, 3);
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].lag, 77, 0.5);
  EXPECT_GT(found[0].correlation, 0.999);
  const auto swapped = FindOffsets({{part, whole}}, 30, 3);
  ASSERT_FALSE(swapped.empty());
  EXPECT_NEAR(swapped[0].lag, -77, 0.5);
}

TEST(FindOffsets, OverlapsThatAreTooShortDoNotCount) {
  const Signal noise = NoiseOf(100, 2);
  for (const OffsetCandidate& one : FindOffsets({{noise, NoiseOf(100, 3)}}, 60, 100))
    EXPECT_LE(std::abs(one.lag), 40.5);
}

TEST(FindOffsets, SignalsThatDoNotChangeHaveNone) {
  EXPECT_TRUE(FindOffsets({{Signal(50, 3.0), Signal(50, 3.0)}}, 10, 3).empty());
}

TEST(Quantiles, DoNotDependOnTheOrder) {
  const std::vector<Signal> signals = {NoiseOf(20, 1), NoiseOf(20, 2), NoiseOf(20, 3)};
  EXPECT_EQ(Quantiles(signals), Quantiles({signals[2], signals[0], signals[1]}));
  EXPECT_EQ(Quantiles(signals)[0].size(), 20u);
}

TEST(Resampled, ManyFramesAreAveragedAndGapsStay) {
  RecordedMotion motion;
  PointTrack track;
  for (int i = 0; i < 100; ++i) {
    motion.time_s.push_back(0.01 * i);
    const bool is_seen = i < 50 || i > 70;
    track.p_mm.push_back(is_seen ? Vector3(i % 2 == 0 ? 1 : -1, 0, 0)
                                 : Vector3(Vector3::Constant(std::nan(""))));
  }
  const auto places = Resampled(motion, track, GridOf(motion, 0.1));
  ASSERT_EQ(places.size(), 10u);
  EXPECT_LT(std::abs(places[2].x()), 0.2);
  EXPECT_TRUE(std::isnan(places[6].x()));
}

}  // namespace
}  // namespace mocap
