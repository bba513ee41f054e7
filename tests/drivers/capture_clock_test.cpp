#include "drivers/capture_clock.h"

#include <gtest/gtest.h>

#include "drivers/frame_counter.h"

namespace mocap {
namespace {

constexpr std::int64_t kNow_ns = 1'750'000'000'000'000'000;
constexpr std::int64_t kOneSecond_ns = 1'000'000'000, kMillisecond_ns = 1'000'000;
constexpr std::int64_t kExposure_ns = 4 * kMillisecond_ns;
constexpr int kLeapSeconds = 37;

/// The middle of an exposure that began at kNow_ns, which the network delayed by 2 ms.
std::int64_t Middle(CaptureClock& clock, std::int64_t stamp_ns, bool ptp_locked) {
  const std::int64_t arrival_ns = kNow_ns + kExposure_ns + 2 * kMillisecond_ns;
  return clock.MiddleOfExposure(stamp_ns, arrival_ns, kExposure_ns, ptp_locked, 0);
}

TEST(CaptureClock, WithoutStampsTheArrivalCounts) {
  CaptureClock clock(false, kLeapSeconds);
  EXPECT_EQ(Middle(clock, 0, false), kNow_ns + kExposure_ns / 2 + 2 * kMillisecond_ns);
  EXPECT_EQ(clock.source(), TimeSource::kArrival);
}

TEST(CaptureClock, DeviceClockIsFittedToTheArrival) {
  CaptureClock clock(true, kLeapSeconds);
  EXPECT_EQ(Middle(clock, 5 * kOneSecond_ns, false),
            kNow_ns + kExposure_ns / 2 + 2 * kMillisecond_ns);
  EXPECT_EQ(clock.source(), TimeSource::kDeviceClock);
}

TEST(CaptureClock, PtpIsTakenAtItsWord) {
  CaptureClock clock(true, kLeapSeconds);
  EXPECT_EQ(Middle(clock, kNow_ns, true), kNow_ns + kExposure_ns / 2);
  EXPECT_EQ(clock.source(), TimeSource::kPtp);
}

TEST(CaptureClock, LeapSecondsOfTaiAreTakenAway) {
  CaptureClock clock(true, kLeapSeconds);
  EXPECT_EQ(Middle(clock, kNow_ns + kLeapSeconds * kOneSecond_ns, true),
            kNow_ns + kExposure_ns / 2);
  EXPECT_EQ(clock.source(), TimeSource::kPtpTai);
}

TEST(CaptureClock, PtpWithAnEpochOfItsOwnIsFitted) {
  CaptureClock clock(true, kLeapSeconds);
  EXPECT_EQ(Middle(clock, 5 * kOneSecond_ns, true),
            kNow_ns + kExposure_ns / 2 + 2 * kMillisecond_ns);
  EXPECT_EQ(clock.source(), TimeSource::kDeviceClock);
}

TEST(CaptureClock, PtpGoesThroughTheTimeOfDayToTheTimeline) {
  CaptureClock clock(true, kLeapSeconds);
  const std::int64_t ahead_ns = -3600 * kOneSecond_ns;
  const std::int64_t arrival_ns = kNow_ns + kExposure_ns + 2 * kMillisecond_ns;
  EXPECT_EQ(clock.MiddleOfExposure(kNow_ns + ahead_ns, arrival_ns, kExposure_ns, true, ahead_ns),
            kNow_ns + kExposure_ns / 2);
  EXPECT_EQ(clock.source(), TimeSource::kPtp);
}

TEST(CaptureClock, WherePtpStaysAndTheHostIsSetCaptureTimesGoOn) {
  for (const std::int64_t step_ns : {-3600 * kOneSecond_ns, -800 * kMillisecond_ns,
                                     800 * kMillisecond_ns, 3600 * kOneSecond_ns}) {
    CaptureClock clock(true, kLeapSeconds);
    constexpr std::int64_t kPeriod_ns = 10 * kMillisecond_ns;
    for (int i = 0; i < 100; ++i) {
      const std::int64_t begin_ns = kNow_ns + i * kPeriod_ns;
      const std::int64_t capture_ns = clock.MiddleOfExposure(
          begin_ns, begin_ns + kExposure_ns, kExposure_ns, true, i < 50 ? 0 : step_ns);
      EXPECT_EQ(capture_ns, begin_ns + kExposure_ns / 2) << i << ", " << step_ns;
    }
    EXPECT_EQ(clock.source(), TimeSource::kDeviceClock);
  }
}

TEST(CaptureClock, CameraThatWasAwayKeepsItsClockIfItWentOn) {
  CaptureClock clock(true, kLeapSeconds);
  Middle(clock, 5 * kOneSecond_ns, false);
  clock.Doubt();
  // Held up by 300 ms more than the frame before.
  const std::int64_t late_ns = kNow_ns + kOneSecond_ns + kExposure_ns + 302 * kMillisecond_ns;
  EXPECT_EQ(clock.MiddleOfExposure(6 * kOneSecond_ns, late_ns, kExposure_ns, false, 0),
            kNow_ns + kOneSecond_ns + kExposure_ns / 2 + 2 * kMillisecond_ns);
}

TEST(CaptureClock, CameraThatWasSwitchedOffIsLearnedAnewAtOnce) {
  CaptureClock clock(true, kLeapSeconds);
  Middle(clock, 500 * kOneSecond_ns, false);
  clock.Doubt();
  EXPECT_EQ(Middle(clock, 3 * kOneSecond_ns, false),
            kNow_ns + kExposure_ns / 2 + 2 * kMillisecond_ns);
}

TEST(FrameCounter, GoesOnWhereNumbersWrap) {
  FrameCounter counter;
  EXPECT_EQ(counter.Next(65534), 0u);
  EXPECT_EQ(counter.Next(65535), 1u);
  EXPECT_EQ(counter.Next(1), 2u);
  EXPECT_EQ(counter.Next(2), 3u);
}

TEST(FrameCounter, GapsAreKeptAcrossTheWrap) {
  FrameCounter counter;
  counter.Next(65530);
  EXPECT_EQ(counter.Next(5), 10u);
  EXPECT_EQ(counter.Next(15), 20u);
}

TEST(FrameCounter, WideNumbersDoNotWrap) {
  FrameCounter counter;
  counter.Next(65535);
  EXPECT_EQ(counter.Next(65536), 1u);
  EXPECT_EQ(counter.Next(65546), 11u);
}

TEST(FrameCounter, CameraThatBeginsAnewGoesOn) {
  FrameCounter counter;
  counter.Next(100);
  EXPECT_EQ(counter.Next(1), 1u);
  counter.Forget();
  EXPECT_EQ(counter.Next(900), 2u);
  EXPECT_EQ(counter.Next(902), 4u);
}

}  // namespace
}  // namespace mocap
