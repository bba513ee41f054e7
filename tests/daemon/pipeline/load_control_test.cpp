#include "daemon/pipeline/load_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace mocap {
namespace {

constexpr std::int64_t kLoadPeriod = 60'000'000;
constexpr std::int64_t kDelay = 1000;
constexpr auto kMost = LoadControl::kMostUnderWay;
constexpr std::int64_t kTolerance = LoadControl::kPatienceNs;
static_assert(LoadControl::kTolerancePeriods * kLoadPeriod < kTolerance);

/// Adds a set that had arrived a moment after its capture and is complete `age_ns` later.
void Add(LoadControl& control, std::int64_t capture_ns, std::int64_t age_ns) {
  const std::int64_t arrival_ns = capture_ns + kDelay;
  control.AddSet(capture_ns, arrival_ns, arrival_ns + age_ns, kLoadPeriod);
}

TEST(LoadControl, WantsEveryFrameWhileSetsAreYoungAndFew) {
  LoadControl control;
  for (int i = 0; i < 10; ++i) {
    Add(control, i * kLoadPeriod, kTolerance);
    control.SetUnderWay(std::min(i + 1, 7), i * kLoadPeriod + 2 * kDelay);
  }
  EXPECT_LT(control.wanted_from_ns(), 0);
  EXPECT_EQ(control.skipped(), 0);
}

TEST(LoadControl, AnOldSetIsFollowedByTheNextFrameToBeCaptured) {
  LoadControl control;
  constexpr std::int64_t kPeriods = kTolerance / kLoadPeriod + 1;
  Add(control, 0, kPeriods * kLoadPeriod + 5);
  EXPECT_EQ(control.wanted_from_ns(), kPeriods * kLoadPeriod + kLoadPeriod / 2);
}

TEST(LoadControl, IsPatientOnceAndThenKeepsSetsYoung) {
  constexpr std::int64_t kFast = 10'000'000;
  constexpr std::int64_t kUsual = LoadControl::kTolerancePeriods * kFast;
  constexpr std::int64_t kLater = LoadControl::kLatelyNs + 2 * LoadControl::kPatienceNs;
  LoadControl control;
  const auto add = [&](std::int64_t capture_ns, std::int64_t age_ns) {
    control.AddSet(capture_ns, capture_ns, capture_ns + age_ns, kFast);
    return control.wanted_from_ns() > capture_ns;
  };
  EXPECT_FALSE(add(0, LoadControl::kPatienceNs));
  EXPECT_TRUE(add(kFast, LoadControl::kPatienceNs + 1));
  EXPECT_TRUE(add(2 * LoadControl::kPatienceNs, kUsual + 1));
  EXPECT_FALSE(add(3 * LoadControl::kPatienceNs, kUsual));
  EXPECT_FALSE(add(3 * LoadControl::kPatienceNs + kLater, LoadControl::kPatienceNs));
}

TEST(LoadControl, WantsNothingWhileTooManySetsAreUnderWay) {
  LoadControl control;
  Add(control, 0, 0);
  control.SetUnderWay(kMost, kLoadPeriod);
  EXPECT_EQ(control.wanted_from_ns(), std::numeric_limits<std::int64_t>::max());
  control.SetUnderWay(1, 5 * kLoadPeriod + 2 * kDelay);
  EXPECT_EQ(control.wanted_from_ns(), 5 * kLoadPeriod + kLoadPeriod / 2);
}

TEST(LoadControl, WantsNothingWhileASetWaitsBehindAnOldOne) {
  LoadControl control;
  Add(control, 0, 0);
  Add(control, kLoadPeriod, 0);
  const std::int64_t old_ns = kTolerance + 2 * kDelay;
  control.SetUnderWay(1, old_ns);
  EXPECT_LT(control.wanted_from_ns(), 0) << "one alone holds up nothing";
  control.SetUnderWay(2, old_ns);
  EXPECT_EQ(control.wanted_from_ns(), std::numeric_limits<std::int64_t>::max());
}

TEST(LoadControl, WantsAllAfterTheClockWasPutBack) {
  LoadControl control;
  Add(control, 1'000'000 * kLoadPeriod, 0);
  control.SetUnderWay(kMost, 1'000'001 * kLoadPeriod);
  control.StartAnew();
  EXPECT_EQ(control.wanted_from_ns(), std::numeric_limits<std::int64_t>::min());
  control.SetUnderWay(kMost, 0);
  control.SetUnderWay(1, kLoadPeriod);
  EXPECT_EQ(control.wanted_from_ns(), std::numeric_limits<std::int64_t>::min());
  Add(control, 2 * kLoadPeriod, 0);
  EXPECT_EQ(control.skipped(), 0);
}

TEST(LoadControl, LosesNothingWhenThereIsRoomAgainBeforeTheNextFrame) {
  LoadControl control;
  Add(control, 0, 0);
  control.SetUnderWay(kMost, 100);
  control.SetUnderWay(kMost - 1, kLoadPeriod / 2);
  Add(control, kLoadPeriod, 0);
  EXPECT_EQ(control.wanted_from_ns(), kLoadPeriod / 2);
  EXPECT_EQ(control.skipped(), 0);
}

TEST(LoadControl, CountsTheSetsThatWereLeftOut) {
  LoadControl control;
  constexpr std::int64_t kTooOld = kTolerance / kLoadPeriod + 1;
  Add(control, 0, kTooOld * kLoadPeriod);
  EXPECT_EQ(control.skipped(), 0) << "the set after the gap has not come yet";
  Add(control, (kTooOld + 1) * kLoadPeriod + 100, kLoadPeriod);
  EXPECT_EQ(control.skipped(), kTooOld);
  Add(control, (kTooOld + 3) * kLoadPeriod, kLoadPeriod);
  EXPECT_EQ(control.skipped(), kTooOld) << "a frame that no camera took was not left out here";
}

TEST(LoadControl, ADelayThatCannotBeIsForgotten) {
  // Of one set the arrival was read by a clock that had just been put back by 0.8 s.
  LoadControl control;
  control.AddSet(0, kDelay - 800'000'000, kDelay, kLoadPeriod);
  constexpr std::int64_t kForgotten = (2 * LoadControl::kDelaySpanNs + 1'000'000'000) / kLoadPeriod;
  std::int64_t left_out_before = 0, left_out_after = 0;
  for (int i = 1; i < 2 * kForgotten; ++i) {
    const std::int64_t capture_ns = i * kLoadPeriod;
    // One set takes its time, after which those that follow have to be young.
    const std::int64_t age_ns = i == 5 ? kTolerance : 0;
    if (capture_ns < control.wanted_from_ns()) {
      ++(i < kForgotten ? left_out_before : left_out_after);
      continue;
    }
    Add(control, capture_ns, age_ns);
  }
  EXPECT_GT(left_out_before, 0);
  EXPECT_EQ(left_out_after, 0);
}

TEST(LoadControl, AConstantDelayBeforeArrivalIsNoAge) {
  LoadControl control;
  for (int i = 0; i < 10; ++i) {
    const std::int64_t arrival_ns = (i + 9) * kLoadPeriod;
    control.AddSet(i * kLoadPeriod, arrival_ns, arrival_ns + kLoadPeriod, kLoadPeriod);
  }
  EXPECT_LT(control.wanted_from_ns(), 0);
}

}  // namespace
}  // namespace mocap
