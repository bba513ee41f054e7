#include "daemon/service/stop_signals.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

namespace mocap {
namespace {

/// Never comes round, as a driver or a disk that does not answer.
[[noreturn]] void Hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

class StopSignalsDeathTest : public ::testing::Test {
 protected:
  StopSignalsDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(StopSignalsDeathTest, AStartThatHangsIsEndedAndLosesNothing) {
  EXPECT_EXIT(
      {
        HoldSignals();
        const StopSignals signals;
        kill(getpid(), SIGTERM);
        Hang();
      },
      ::testing::ExitedWithCode(0), "stopped while starting");
}

TEST_F(StopSignalsDeathTest, ATakeThatCannotBeCompletedIsTold) {
  EXPECT_EXIT(
      {
        HoldSignals();
        StopSignals signals;
        signals.Allow(std::chrono::milliseconds(1), true);
        kill(getpid(), SIGINT);
        Hang();
      },
      ::testing::ExitedWithCode(1), "keeps .partial in its name");
}

TEST_F(StopSignalsDeathTest, AnEndThatComesInTimeIsLeftAlone) {
  EXPECT_EXIT(
      {
        HoldSignals();
        StopSignals signals;
        signals.Allow(std::chrono::hours(1), false);
        kill(getpid(), SIGHUP);
        kill(getpid(), SIGTERM);
        while (!signals.stop().load()) signals.Wait(std::chrono::hours(1));
        _exit(signals.TakeReload() ? 7 : 8);
      },
      ::testing::ExitedWithCode(7), "");
}

TEST_F(StopSignalsDeathTest, APipeThatNobodyReadsEndsNothing) {
  EXPECT_EXIT(
      {
        HoldSignals();
        kill(getpid(), SIGPIPE);
        _exit(7);
      },
      ::testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace mocap
