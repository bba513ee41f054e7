#include "tools/accuracy/variety_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/support/setup_error.h"

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

VarietyRow Found(double mpjpe_mm, double found_s, double lost_s, int wrong) {
  VarietyRow row{.accuracy = {.motion = "walk", .mpjpe_mm = mpjpe_mm}, .looks = "gown"};
  row.accuracy.longest_wrong_stretch = wrong;
  row.found_s = found_s;
  row.lost_s = lost_s;
  return row;
}

VarietyRow Never() { return {.accuracy = {.motion = "sit"}, .looks = "afro"}; }

TEST(Variety, WhoWasNeverFoundIsCountedAndNotAveraged) {
  const std::vector rows = {Found(20, 0.1, 0, 0), Found(40, 0.6, 0, 0), Found(60, 0.1, 0.4, 6),
                            Never()};
  EXPECT_THAT(
      VarietySummaryText(rows),
      AllOf(HasSubstr("1 never found, 1 found after more than 0.5 s, 1 lost"),
            HasSubstr("1 tracked in a wrong pose; 40.0 mm in the mean (60.0 mm the worst)")));
  EXPECT_THAT(VarietyLine(rows[3]), AllOf(HasSubstr("never"), HasSubstr("afro")));
}

TEST(Variety, TheWorstComeFirstAndTheNeverFoundBeforeThem) {
  const std::vector<VarietyGrid> grids = {
      {Filmings().front(), {Found(20, 0.1, 0, 0), Never(), Found(300, 0.1, 0, 0)}}};
  const std::string text = VarietyMarkdown(grids);
  const std::size_t worst = text.find("The worst");
  ASSERT_NE(worst, std::string::npos);
  const std::size_t never = text.find("| never |", worst), bad = text.find("| 300.0 |", worst);
  EXPECT_LT(never, bad);
  EXPECT_LT(bad, text.find("| 20.0 |", worst));
  EXPECT_EQ(VarietyMarkdown({}), "");
}

TEST(Variety, ATrialGivesTheSameForTheSamePerson) {
  const Filming filming{.label = "30 Hz", .cameras = 4};
  const VarietyRow row = RunVarietyTrial(9, 0.5, filming);
  EXPECT_EQ(row.looks, "plain");
  EXPECT_GE(row.found_s, 0);
  EXPECT_LT(row.accuracy.mpjpe_mm, 60);
  EXPECT_EQ(RunVarietyTrial(9, 0.5, filming).accuracy.mpjpe_mm, row.accuracy.mpjpe_mm);
}

TEST(Variety, SeveralFirstSetsAreScoredInTheSameSets) {
  const Filming filming{.label = "10 Hz", .fps = 10, .cameras = 4};
  const VarietyRow row = RunVarietyTrial(9, 1, filming, 3);
  ASSERT_EQ(row.score.firsts.size(), 3u);
  EXPECT_GT(row.score.sets, 0);
  EXPECT_LE(row.score.sets, 8) << "the first two of ten sets belong to no score";
  ASSERT_TRUE(row.score.Mean());
  EXPECT_DOUBLE_EQ(row.accuracy.mpjpe_mm, row.score.Mean()->mean_mm);
  EXPECT_GT(row.score.spread_mm(), 0);
  EXPECT_THAT(testing::SetupErrorOf([&] { RunVarietyTrial(9, 0.5, filming, 6); }),
              HasSubstr("--seconds: 0.5 s at 10 Hz have fewer than 6 frame sets"));
}

// Helmet, skirt, backpack and bag.
TEST(Variety, ABackpackIsNotTakenForAChest) {
  const VarietyRow row = RunVarietyTrial(2, 1, {.label = "30 Hz"});
  EXPECT_NE(row.looks.find("backpack"), std::string::npos);
  EXPECT_LT(row.accuracy.mpjpe_mm, 120);
}

}  // namespace
}  // namespace mocap
