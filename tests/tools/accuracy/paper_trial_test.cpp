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
  studio.seconds = 3;
  return studio;
}

TEST(PaperTrial, EveryTruthHelps) {
  const PaperRow row = RunPaperTrial(ShortTake());
  for (std::size_t rate = 0; rate < kPaperSteps.size(); ++rate) {
    const double nothing_mm = row.scores[0][rate].mean_mm, start_mm = row.scores[1][rate].mean_mm,
                 parts_mm = row.scores[2][rate].mean_mm;
    EXPECT_LT(start_mm, nothing_mm) << "step " << kPaperSteps[rate];
    EXPECT_LT(parts_mm, start_mm) << "step " << kPaperSteps[rate];
    EXPECT_GT(parts_mm, 0) << "step " << kPaperSteps[rate];
    for (const auto& scores : row.scores) EXPECT_TRUE(scores[rate].acquired);
  }
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
