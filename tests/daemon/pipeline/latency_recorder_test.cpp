#include "daemon/pipeline/latency_recorder.h"

#include <gtest/gtest.h>

#include <limits>

namespace mocap {
namespace {

constexpr std::int64_t kLatencyMs = 1'000'000;

TEST(LatencyRecorder, PercentilesKeepThreePercent) {
  LatencyRecorder recorder;
  for (int ms = 1; ms <= 1000; ++ms) recorder.Record(ms * kLatencyMs);
  const LatencyHistogram histogram = recorder.Snapshot();
  EXPECT_EQ(histogram.count(), 1000);
  EXPECT_NEAR(histogram.PercentileMs(0.5), 500, 15);
  EXPECT_NEAR(histogram.PercentileMs(0.99), 990, 30);
  EXPECT_NEAR(histogram.MaxMs(), 1000, 30);
}

TEST(LatencyRecorder, EveryDurationLiesInTheBucketThatItIsCountedIn) {
  for (std::int64_t ns = 1; ns < 100'000 * kLatencyMs; ns = ns * 5 / 4 + 1) {
    const std::size_t bucket = LatencyBuckets::IndexOf(ns);
    EXPECT_GE(static_cast<double>(ns), LatencyBuckets::BeginNs(bucket));
    EXPECT_LT(static_cast<double>(ns), LatencyBuckets::BeginNs(bucket + 1));
  }
}

TEST(LatencyRecorder, TakesWhatNoClockShouldGive) {
  LatencyRecorder recorder;
  recorder.Record(-5);
  recorder.Record(std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(recorder.Snapshot().count(), 2);
}

TEST(LatencyRecorder, NothingRecordedIsZero) {
  EXPECT_EQ(LatencyRecorder().Snapshot().PercentileMs(0.5), 0);
}

TEST(LatencyRecorder, SinceTellsWhatIsNew) {
  LatencyRecorder recorder;
  recorder.Record(1000 * kLatencyMs);
  const LatencyHistogram before = recorder.Snapshot();
  recorder.Record(10 * kLatencyMs);
  const LatencyHistogram later = recorder.Snapshot().Since(before);
  EXPECT_EQ(later.count(), 1);
  EXPECT_NEAR(later.MaxMs(), 10, 0.3);
}

}  // namespace
}  // namespace mocap
