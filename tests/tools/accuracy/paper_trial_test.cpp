#include "tools/accuracy/paper_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/core/mikic2003/paper_person.h"
#include "tools/accuracy/accuracy_benchmark.h"
#include "tools/accuracy/paper_report.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

SimulatedStudioOptions ShortTake() {
  SimulatedStudioOptions studio = RecordedSimulation();
  studio.width_px = 320;
  studio.height_px = 240;
  studio.seconds = 1.5;
  return studio;
}

// In the mean over the rates: a short take at one rate may gain by luck.
TEST(PaperTrial, EveryTruthHelps) {
  const PaperRow row = RunPaperTrial(ShortTake());
  const auto mean_mm = [&row](std::size_t truth) {
    double sum_mm = 0;
    for (const PaperScore& score : row.scores[truth]) {
      EXPECT_TRUE(score.acquired);
      EXPECT_GT(score.mean_mm, 0);
      sum_mm += score.mean_mm;
    }
    return sum_mm / static_cast<double>(row.scores[truth].size());
  };
  EXPECT_LT(mean_mm(1), mean_mm(0));
  EXPECT_LT(mean_mm(2), mean_mm(1));
}

TEST(PaperTrial, NothingReplacedIsTheTrackerOfTheDaemon) {
  AccuracyTrial trial;
  trial.studio = ShortTake();
  trial.tracker = TrackerKind::kMikic2003;
  trial.body = "mikic2003";
  const AccuracyRow row = Measure(trial);
  const CarvedTake take = CarveTake(trial.studio);
  EXPECT_EQ(ScoreTake(take, 1, PaperTruth::kNothing).mean_mm, row.mpjpe_mm);
}

/// Somebody who stands still for two seconds, at 10 Hz.
CarvedTake Standing() {
  const mikic2003::PaperPerson person;
  const PoseState pose = person.Pose(mikic2003::kSpread);
  CarvedTake take{.motion = "stand", .stature_mm = 1750, .seed = 1, .frames = {}};
  for (int frame = 0; frame < 20; ++frame) {
    take.frames.push_back({frame * 100'000'000, person.Grid(pose),
                           ScoredPointsOf(person.body.PointsAt(person.body.PostureAt(pose)))});
  }
  return take;
}

TEST(PaperScore, AFirstSecondOfAcquisitionDoesNotCountAsLost) {
  const PaperScore score = ScoreTake(Standing(), 1, PaperTruth::kNothing);
  EXPECT_TRUE(score.acquired);
  EXPECT_EQ(score.tracked_share, 1);
  EXPECT_EQ(score.head_share, 1);
  EXPECT_LT(score.mean_mm, 70);
}

TEST(PaperScore, SaysSoOfSomebodyWhoIsNeverSeen) {
  CarvedTake take = Standing();
  for (CarvedTake::Frame& frame : take.frames) frame.flesh.Reset({0, 0, 0}, {0, 0, 0}, 25);
  const PaperScore score = ScoreTake(take, 1, PaperTruth::kNothing);
  EXPECT_FALSE(score.acquired);
  EXPECT_EQ(score.tracked_share, 0);
}

PaperRow Row(const std::string& motion, const PaperScore& nothing) {
  PaperRow row{.motion = motion, .stature_mm = 1750, .seed = 1};
  row.scores[0].fill(nothing);
  return row;
}

TEST(PaperReport, WhoIsNeverAcquiredIsCountedAndNotAveraged) {
  const std::vector rows = {Row("walk", {.acquired = true,
                                         .mean_mm = 80,
                                         .median_mm = 70,
                                         .head_share = 0.5,
                                         .tracked_share = 1}),
                            Row("walk", {.acquired = true,
                                         .mean_mm = 100,
                                         .median_mm = 80,
                                         .head_share = 1,
                                         .tracked_share = 0.5}),
                            Row("sit", {})};
  const std::string text = PaperTables(rows);
  EXPECT_THAT(text, HasSubstr("| nothing | 90 ± 10 (2) | 90 ± 10 (2) |\n"));
  EXPECT_THAT(text, HasSubstr("| sizes and first pose | – (0) | – (0) |\n"));
  EXPECT_THAT(text, HasSubstr("| walk | 2 | 90 | 75 | 75 | 75 | 2 | 90 | 75 | 75 | 75 |\n"));
  EXPECT_THAT(text, HasSubstr("| sit | 0 | – | – | – | 0 | 0 | – | – | – | 0 |\n"));
  EXPECT_THAT(text, HasSubstr("| all | 2 | 90 | 75 | 75 | 50 | 2 | 90 | 75 | 75 | 50 |\n"));
  EXPECT_THAT(PaperLine(rows[2]), HasSubstr("never"));
  EXPECT_THAT(PaperMarkdown(rows, 4), HasSubstr(text));
  EXPECT_EQ(PaperMarkdown({}, 4), "");
}

}  // namespace
}  // namespace mocap
