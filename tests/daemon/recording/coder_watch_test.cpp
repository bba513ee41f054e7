// When coding threads come forward, and what is blamed for frames that are lost.
#include "daemon/recording/coder_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include "drivers/go_behind.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kTickNs = 20'000'000;

TEST(Urgency, ACoderThatKeepsUpStaysBehind) {
  Urgency urgency;
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(urgency.Update(i % 2, i / 2, i * kTickNs)) << i;
  }
}

TEST(Urgency, AFrameThatIsStuckBringsItsCoderForward) {
  Urgency urgency;
  EXPECT_FALSE(urgency.Update(1, 0, kTickNs));
  std::int64_t now_ns = kTickNs;
  while (!urgency.Update(1, 0, now_ns)) now_ns += kTickNs;
  EXPECT_LE(now_ns, 2 * kTickNs + Urgency::kPatienceNs);
}

TEST(Urgency, FramesThatPileUpBringTheirCoderForwardThoughItMoves) {
  Urgency urgency;
  bool is_urgent = false;
  for (int i = 1; i <= 10; ++i) is_urgent = urgency.Update(2 + i, i, i * kTickNs);
  EXPECT_TRUE(is_urgent);
}

TEST(Urgency, ACoderThatHasCaughtUpGoesBehindAgainAfterAWhile) {
  Urgency urgency;
  for (int i = 1; i <= 10; ++i) urgency.Update(5, 0, i * kTickNs);
  const std::int64_t caught_up_ns = 11 * kTickNs;
  EXPECT_TRUE(urgency.Update(0, 5, caught_up_ns));
  EXPECT_TRUE(urgency.Update(0, 5, caught_up_ns + Urgency::kCalmNs - 1));
  EXPECT_FALSE(urgency.Update(0, 5, caught_up_ns + Urgency::kCalmNs));
}

TEST(CoderWatch, BringsACoderForwardThatLeavesFramesWaiting) {
  if (!MayComeForward()) GTEST_SKIP() << "takes CAP_SYS_NICE or RLIMIT_NICE";
  FrameTap tap;
  Doorbell bell;
  tap.Open(4, {}, bell);
  Coder coder;
  coder.tap = &tap;
  std::atomic<bool> has_come{false};
  coder.thread = std::thread([&] {
    GoBehind("coder");
    coder.id.store(gettid());
    while (sched_getscheduler(0) == SCHED_IDLE) std::this_thread::yield();
    has_come.store(true);
  });
  tap.Offer([](TappedFrame&) { return true; });
  {
    const CoderWatch watch({&coder}, true);
    while (!has_come.load()) std::this_thread::yield();
  }
  coder.thread.join();
  EXPECT_TRUE(has_come.load());
}

TEST(CoderWatch, SaysNothingWhileNothingIsLost) {
  FrameTap tap;
  Doorbell bell;
  tap.Open(4, {}, bell);
  Coder coder;
  coder.tap = &tap;
  const CoderWatch watch({&coder}, false);
  EXPECT_FALSE(watch.cause());
}

TEST(LossCause, IsWhereTheTimeWent) {
  constexpr int kProcessors = 2;
  EXPECT_EQ(CauseOf({.ran_ns = 10, .queued_ns = 90, .wall_ns = 100}, kProcessors),
            LossCause::kOtherWork);
  EXPECT_EQ(CauseOf({.ran_ns = 90, .queued_ns = 10, .wall_ns = 100}, kProcessors),
            LossCause::kCodec);
  EXPECT_EQ(CauseOf({.ran_ns = 10, .queued_ns = 20, .blocked_ns = 70, .wall_ns = 100}, kProcessors),
            LossCause::kDisk);
  EXPECT_EQ(CauseOf({.ran_ns = 10, .queued_ns = 20, .held_ns = 70, .wall_ns = 100}, kProcessors),
            LossCause::kPoses);
  EXPECT_EQ(CauseOf({}, kProcessors), LossCause::kUnknown);
}

TEST(LossCause, CodersThatKeepEachOtherFromTheProcessorAreTooSlow) {
  EXPECT_EQ(CauseOf({.ran_ns = 180, .queued_ns = 420, .wall_ns = 100}, 2), LossCause::kCodec);
}

TEST(LossCause, AdviceHoldsForEachCodec) {
  EXPECT_THAT(TextOf(LossCause::kCodec), HasSubstr("\"raw\" is the fastest, then \"huffyuv\""));
  EXPECT_THAT(TextOf(LossCause::kDisk), HasSubstr("\"ffv1\" writes the least, then \"huffyuv\""));
}

TEST(ThreadTimes, AThreadThatRanHasSpentTime) {
  const auto times = ReadThreadTimes(gettid());
  if (!times) GTEST_SKIP() << "this kernel has no schedstat, which tells how long threads waited";
  EXPECT_GT(times->ran_ns, 0);
  EXPECT_GE(times->queued_ns, 0);
  EXPECT_FALSE(ReadThreadTimes(-1));
}

}  // namespace
}  // namespace mocap
