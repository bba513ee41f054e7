#include "drivers/clock.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

constexpr std::int64_t kHostSecond_ns = 1'000'000'000;
constexpr std::int64_t kStart_ns = 1'750'000'000 * kHostSecond_ns, kBoot_ns = 5000 * kHostSecond_ns;
constexpr std::int64_t kSteps_ns[] = {-3600 * kHostSecond_ns, -kHostSecond_ns * 8 / 10,
                                      kHostSecond_ns * 8 / 10, 3600 * kHostSecond_ns};

/// A host whose clocks are set by the test.
class HostClockTest : public ::testing::Test {
 protected:
  void Pass(std::int64_t duration_ns) {
    now_.monotonic_ns += duration_ns;
    now_.time_of_day_ns += duration_ns;
  }
  std::int64_t Now() const { return clock_.FromMonotonic(now_.monotonic_ns); }

  ClockReading now_{kBoot_ns, kStart_ns, 100};
  HostClock clock_{[this] { return now_; }};
};

TEST_F(HostClockTest, TheTimelineBeginsWithTheTimeOfDayAndNeverSteps) {
  EXPECT_EQ(Now(), kStart_ns);
  for (const std::int64_t step_ns : kSteps_ns) {
    const std::int64_t before_ns = Now();
    now_.time_of_day_ns += step_ns;
    EXPECT_EQ(Now(), before_ns) << step_ns;
    Pass(kHostSecond_ns);
    EXPECT_EQ(Now(), before_ns + kHostSecond_ns);
  }
}

TEST_F(HostClockTest, TheTimeOfDayFollowsEachStep) {
  for (const std::int64_t step_ns : kSteps_ns) {
    now_.time_of_day_ns += step_ns;
    Pass(kHostSecond_ns);
    EXPECT_EQ(clock_.ToTimeOfDay(Now()), now_.time_of_day_ns) << step_ns;
  }
}

TEST_F(HostClockTest, TwoClocksThatWereReadApartAreNoStep) {
  now_.time_of_day_ns += 3'000'000;
  now_.width_ns = 4'000'000;
  EXPECT_EQ(clock_.OffsetNs(), 0);
  now_.width_ns = 100;
  EXPECT_EQ(clock_.OffsetNs(), 3'000'000);
}

TEST_F(HostClockTest, AStampOfTheTimeOfDayIsUnderstoodAcrossAStep) {
  constexpr std::int64_t kAge_ns = 5'000'000;
  for (const std::int64_t step_ns : kSteps_ns) {
    clock_.OffsetNs();
    const std::int64_t stamp_before_ns = now_.time_of_day_ns;
    const std::int64_t stamped_ns = Now();
    Pass(kAge_ns / 2);
    now_.time_of_day_ns += step_ns;
    const std::int64_t stamp_after_ns = now_.time_of_day_ns;
    Pass(kAge_ns / 2);
    EXPECT_EQ(clock_.FromRecentTimeOfDay(stamp_before_ns, now_), stamped_ns) << step_ns;
    EXPECT_EQ(clock_.FromRecentTimeOfDay(stamp_after_ns, now_), stamped_ns + kAge_ns / 2)
        << step_ns;
  }
}

TEST_F(HostClockTest, AStampOfTheFutureIsOfNow) {
  EXPECT_EQ(clock_.FromRecentTimeOfDay(now_.time_of_day_ns + kHostSecond_ns, now_), Now());
}

TEST_F(HostClockTest, AStampThatWasHeldUpLongAfterAStepIsOfItsTime) {
  for (const std::int64_t step_ns : kSteps_ns) {
    now_.time_of_day_ns += step_ns;
    clock_.OffsetNs();
    Pass(60 * kHostSecond_ns);
    const std::int64_t stamp_ns = now_.time_of_day_ns, stamped_ns = Now();
    Pass(2 * kHostSecond_ns);
    EXPECT_EQ(clock_.FromRecentTimeOfDay(stamp_ns, now_), stamped_ns) << step_ns;
  }
}

TEST(Clock, SleepingUntilATimeThatIsPastReturns) {
  SleepUntil(TimelineNs() - 3600 * kHostSecond_ns);
  const std::int64_t due_ns = TimelineNs() + 1'000'000;
  SleepUntil(due_ns);
  EXPECT_GE(TimelineNs(), due_ns);
}

}  // namespace
}  // namespace mocap
