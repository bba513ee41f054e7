#include "daemon/nodes/node_clock.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

constexpr std::int64_t kClockMs = 1'000'000;

/// Messages for a second, ten milliseconds apart. @return  whether the last can be used.
bool TakeForASecond(NodeClock& clock, std::int64_t transit_ns, std::int64_t& now_ns,
                    std::int64_t set_ns = 0) {
  bool is_usable = false;
  for (int i = 0; i < 100; ++i) is_usable = clock.Take(transit_ns, set_ns, now_ns += 10 * kClockMs);
  return is_usable;
}

TEST(NodeClock, AgreesWithinWhatTheNetworkTakes) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  EXPECT_TRUE(TakeForASecond(clock, kClockMs / 2, now_ns));
  EXPECT_TRUE(clock.agrees());
  EXPECT_EQ(clock.apart_ns(), kClockMs / 2);
}

TEST(NodeClock, JitterIsNoClock) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(clock.Take(i % 4 == 0 ? kClockMs : 60 * kClockMs, 0, now_ns += 10 * kClockMs)) << i;
  }
}

TEST(NodeClock, AClockThatIsPutForwardIsNoticedAtOnce) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  TakeForASecond(clock, kClockMs, now_ns);
  EXPECT_FALSE(clock.Take(-49 * kClockMs, 0, now_ns += 10 * kClockMs));
  EXPECT_FALSE(clock.agrees());
  EXPECT_EQ(clock.apart_ns(), -49 * kClockMs);
}

TEST(NodeClock, AClockThatIsPutBackIsNoticedWithinASecond) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  TakeForASecond(clock, kClockMs, now_ns);
  EXPECT_FALSE(TakeForASecond(clock, 51 * kClockMs, now_ns));
  EXPECT_EQ(clock.apart_ns(), 51 * kClockMs);
}

TEST(NodeClock, WhatComesFromAnHourAgoIsOfNoUseFromTheFirstOn) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  TakeForASecond(clock, kClockMs, now_ns);
  EXPECT_FALSE(clock.Take(3'600'000 * kClockMs, 0, now_ns += 10 * kClockMs));
}

TEST(NodeClock, ClocksThatAgreeAgainAreUsedWithinASecond) {
  for (const std::int64_t apart_ns :
       {-3'600'000 * kClockMs, -50 * kClockMs, 50 * kClockMs, 3'600'000 * kClockMs}) {
    NodeClock clock;
    std::int64_t now_ns = 0;
    EXPECT_FALSE(TakeForASecond(clock, apart_ns, now_ns));
    EXPECT_TRUE(TakeForASecond(clock, kClockMs, now_ns)) << apart_ns;
  }
}

// Whether it is right after that takes a while to tell, and what comes meanwhile cannot be used.
TEST(NodeClock, AClockThatTellsThatItWasSetIsJudgedAnew) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  TakeForASecond(clock, kClockMs, now_ns);
  EXPECT_FALSE(clock.Take(4 * kClockMs, -3 * kClockMs, now_ns += 10 * kClockMs));
  EXPECT_TRUE(TakeForASecond(clock, 4 * kClockMs, now_ns, -3 * kClockMs));
  EXPECT_FALSE(clock.Take(52 * kClockMs, -51 * kClockMs, now_ns += 10 * kClockMs));
  EXPECT_FALSE(TakeForASecond(clock, 52 * kClockMs, now_ns, -51 * kClockMs));
  EXPECT_TRUE(TakeForASecond(clock, kClockMs, now_ns, 0));
}

TEST(NodeClock, WhatWasBeforeASilenceDoesNotCount) {
  NodeClock clock;
  std::int64_t now_ns = 0;
  EXPECT_FALSE(TakeForASecond(clock, -50 * kClockMs, now_ns));
  EXPECT_TRUE(clock.Take(kClockMs, 0, now_ns + 2'000 * kClockMs));
}

}  // namespace
}  // namespace mocap
