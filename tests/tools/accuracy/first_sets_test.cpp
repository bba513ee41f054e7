#include "tools/accuracy/first_sets.h"

#include <gtest/gtest.h>

#include <vector>

namespace mocap {
namespace {

/// All points of a set are off by this much, and all angles by a tenth of a radian.
FrameError Off(double error_mm) {
  FrameError error;
  error.point_mm.setConstant(error_mm);
  error.angle_rad.setConstant(0.1);
  return error;
}

ErrorsBySet RunOf(const std::map<std::int64_t, double>& errors_mm) {
  ErrorsBySet run;
  for (const auto& [set, error_mm] : errors_mm) run[set] = Off(error_mm);
  return run;
}

TEST(FirstSets, RunsAreScoredInTheSetsThatAllOfThemTrack) {
  // The first run lost the person in a set in which the second one is far off.
  const std::vector runs = {RunOf({{7, 10}, {8, 20}, {10, 30}}),
                            RunOf({{7, 14}, {8, 24}, {9, 500}, {10, 34}})};
  const PersonScore score = ScoreFirsts(runs, std::vector<std::int64_t>{7, 8, 9, 10});
  EXPECT_EQ(score.sets, 3);
  ASSERT_EQ(score.firsts.size(), 2u);
  EXPECT_NEAR(score.firsts[0].errors->mean_mm, 20, 1e-9);
  EXPECT_NEAR(score.firsts[1].errors->mean_mm, 24, 1e-9);
  EXPECT_NEAR(score.firsts[1].errors->angle_deg, 5.7296, 1e-3);
  EXPECT_NEAR(score.Mean()->mean_mm, 22, 1e-9);
  EXPECT_NEAR(score.spread_mm(), 4, 1e-9);
  EXPECT_DOUBLE_EQ(score.firsts[0].tracked_share, 0.75);
  EXPECT_DOUBLE_EQ(score.tracked_share(), 0.875);
}

TEST(FirstSets, ARunThatNeverTracksTakesNoSetsFromTheOthers) {
  const std::vector runs = {RunOf({{7, 10}, {8, 20}}), RunOf({})};
  const PersonScore score = ScoreFirsts(runs, std::vector<std::int64_t>{7, 8});
  EXPECT_EQ(score.sets, 2);
  EXPECT_FALSE(score.firsts[1].errors);
  EXPECT_NEAR(score.Mean()->mean_mm, 15, 1e-9);
  EXPECT_DOUBLE_EQ(score.spread_mm(), 0);
  EXPECT_DOUBLE_EQ(score.tracked_share(), 0.5);
}

TEST(FirstSets, SetsInWhichNobodyNeedBeTrackedDoNotCount) {
  const std::vector runs = {RunOf({{7, 10}, {8, 20}, {9, 400}}), RunOf({{7, 10}, {8, 20}}),
                            RunOf({{9, 300}})};
  const PersonScore score = ScoreFirsts(runs, std::vector<std::int64_t>{7, 8});
  EXPECT_EQ(score.sets, 2);
  EXPECT_NEAR(score.Mean()->mean_mm, 15, 1e-9);
  EXPECT_FALSE(score.firsts[2].errors);
  EXPECT_DOUBLE_EQ(score.firsts[2].tracked_share, 0);
}

TEST(FirstSets, NobodyHasNoErrors) {
  const PersonScore score =
      ScoreFirsts(std::vector{RunOf({}), RunOf({})}, std::vector<std::int64_t>{7});
  EXPECT_FALSE(score.Mean());
  EXPECT_EQ(score.sets, 0);
  EXPECT_DOUBLE_EQ(score.tracked_share(), 0);
}

}  // namespace
}  // namespace mocap
