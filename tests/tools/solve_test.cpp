#include "tools/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "tests/support/run_command.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/report/evaluation.h"
#include "tools/simulate.h"
#include "tools/track.h"

namespace mocap {
namespace {

namespace fs = std::filesystem;

std::string Output(void (*add)(CLI::App&), const std::string& command_line) {
  ::testing::internal::CaptureStdout();
  testing::RunCommand(add, command_line);
  return ::testing::internal::GetCapturedStdout();
}

/// A walk, tracked and solved.
class Solved : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TemporaryFolder;
    Output(AddSimulateCommand,
           "simulate --motion walk --seconds 2 --fps 15 --width 320 --height 240 --out " + Take());
    Output(AddTrackCommand, "track " + Take() + " --out " + At("live"));
    said_ = Output(AddSolveCommand, "solve " + Take() + " --jobs 2 --out " + At("solved"));
  }
  static void TearDownTestSuite() { delete std::exchange(folder_, nullptr); }

  static std::string At(const std::string& name) { return (folder_->path() / name).string(); }
  static std::string Take() { return At("walk"); }
  static std::string Poses(const std::string& result) {
    return testing::ReadText(fs::path(At(result)) / "poses.csv");
  }
  static Evaluation EvaluationOf(const std::string& result) {
    return Evaluate(ReadResult(At(result)), ReadTakeTruth(Take()));
  }

  static testing::TemporaryFolder* folder_;
  static std::string said_;
};
testing::TemporaryFolder* Solved::folder_ = nullptr;
std::string Solved::said_;

TEST_F(Solved, IsSmootherThanLiveAndNoLessAccurate) {
  const Evaluation live = EvaluationOf("live"), solved = EvaluationOf("solved");
  EXPECT_LT(*solved.jitter_mm - *solved.true_jitter_mm,
            0.5 * (*live.jitter_mm - *live.true_jitter_mm));
  EXPECT_LT(solved.accuracy->distance_mm.mean, live.accuracy->distance_mm.mean + 2);
  EXPECT_EQ(solved.accuracy->tracked_share, 1);
}

TEST_F(Solved, HasARowForEverySetAndSizesFromTheFirstOn) {
  const Result result = ReadResult(At("solved"));
  EXPECT_EQ(result.poses.size(), 30U);
  EXPECT_EQ(result.filter, "none");
  const auto thigh_mm = [](const PoseRow& row) {
    const auto at = [&](Point point) { return row.points_W.col(static_cast<int>(point)); };
    return (at(Point::kHipL) - at(Point::kKneeL)).norm();
  };
  for (const PoseRow& row : result.poses) {
    EXPECT_EQ(row.state, CaptureState::kTracking);
    EXPECT_NEAR(thigh_mm(row), thigh_mm(result.poses.front()), 0.2);
  }
  EXPECT_THAT(said_, ::testing::HasSubstr("30 frame sets, 30 tracked, in "));
}

TEST_F(Solved, DoesNotDependOnTheNumberOfThreads) {
  Output(AddSolveCommand, "solve " + Take() + " --jobs 1 --out " + At("one"));
  EXPECT_EQ(Poses("one"), Poses("solved"));
}

TEST_F(Solved, FiltersAndSaysSo) {
  Output(AddSolveCommand, "solve " + Take() + " --filter butterworth:4:3 --out " + At("filtered"));
  const Evaluation filtered = EvaluationOf("filtered"), plain = EvaluationOf("solved");
  EXPECT_EQ(filtered.result.filter, "butterworth:4:3");
  EXPECT_LT(*filtered.jitter_mm, *plain.jitter_mm);
}

TEST_F(Solved, RefusesFiltersThatItDoesNotKnow) {
  EXPECT_THAT(testing::SetupErrorOf([] {
                testing::RunCommand(AddSolveCommand,
                                    "solve " + Take() + " --filter kalman --out " + At("no"));
              }),
              ::testing::HasSubstr("expected none, or butterworth:ORDER:HZ"));
  EXPECT_FALSE(fs::exists(At("no")));
}

}  // namespace
}  // namespace mocap
