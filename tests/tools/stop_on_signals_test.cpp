#include "tools/stop_on_signals.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "tests/support/box_take.h"
#include "tests/support/run_command.h"
#include "tests/support/temporary_folder.h"
#include "tools/simulate.h"
#include "tools/track.h"

namespace mocap {
namespace {

/// Runs a command to which a signal has come, and ends the process as the program does.
template <typename Add>
[[noreturn]] void RunInterrupted(Add add, const std::string& command_line) {
  StopOnSignals();
  raise(SIGINT);
  try {
    testing::RunCommand(add, command_line);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
  }
  EndBySignal();
  std::_Exit(0);
}

class StopOnSignalsDeathTest : public ::testing::Test {
 protected:
  template <typename Add>
  void ExpectNothingLeft(Add add, const std::string& command_line) const {
    EXPECT_EXIT(RunInterrupted(add, command_line), ::testing::KilledBySignal(SIGINT),
                "interrupted: nothing is written");
    EXPECT_FALSE(std::filesystem::exists(out_));
    EXPECT_FALSE(std::filesystem::exists(out_.string() + ".partial"));
  }

  const testing::TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(StopOnSignalsDeathTest, AnInterruptedSimulationLeavesNoTake) {
  const std::string small = " --cameras 2 --width 32 --height 32 --seconds 0.2";
  ExpectNothingLeft(AddSimulateCommand, "simulate --out " + out_.string() + small);
  ExpectNothingLeft(AddSimulateCommand, "simulate --board floor --out " + out_.string() + small);
}

TEST_F(StopOnSignalsDeathTest, InterruptedTrackingLeavesNoResultAndKeepsAnEarlierOne) {
  const std::filesystem::path take = folder_.path() / "take";
  testing::WriteBoxTake(take);
  const std::string track = "track " + take.string() + " --out ";
  ExpectNothingLeft(AddTrackCommand, track + out_.string());
  const std::filesystem::path earlier = folder_.path() / "earlier";
  testing::WriteBoxResult(earlier);
  const std::string poses = testing::ReadText(earlier / "poses.csv");
  ExpectNothingLeft(AddTrackCommand, track + earlier.string());
  EXPECT_EQ(testing::ReadText(earlier / "poses.csv"), poses);
}

}  // namespace
}  // namespace mocap
