#include "tools/accuracy/people_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/accuracy/accuracy_report.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

PersonAccuracy Followed(double mean_mm, int covered_sets, double found_share, int lost_sets) {
  return {.followed_by = 0,
          .distance_mm = {.mean = mean_mm},
          .covered_sets = covered_sets,
          .covered_found_share = found_share,
          .sets_to_first = 10,
          .longest_lost_sets = lost_sets};
}

TEST(PeopleRow, TellsOfTheWorstAndOfAll) {
  SimulatedStudioOptions studio;
  studio.fps = 10;
  const PeopleRow row =
      SumUp(studio, {.people = {Followed(20, 100, 0.9, 3), Followed(50, 300, 0.5, 12)},
                     .mpjpe_mm = 31,
                     .phantom_sets = 4,
                     .duplicate_sets = 3});
  EXPECT_DOUBLE_EQ(row.worst_person_mm, 50);
  EXPECT_DOUBLE_EQ(row.found_share, 0.6);
  EXPECT_DOUBLE_EQ(row.slowest_found_s, 1);
  EXPECT_DOUBLE_EQ(row.longest_lost_s, 1.2);
  EXPECT_DOUBLE_EQ(row.phantom_s, 0.7);
  EXPECT_EQ(row.never_found, 0);
}

TEST(PeopleRow, SaysSoOfSomebodyWhoWasNeverFound) {
  PersonAccuracy never{.covered_sets = 30, .longest_lost_sets = 30};
  const PeopleRow row = SumUp({}, {.people = {never}});
  EXPECT_EQ(row.never_found, 1);
  EXPECT_DOUBLE_EQ(row.longest_lost_s, 1);
  EXPECT_THAT(PeopleLine(row), HasSubstr("never"));
  EXPECT_THAT(PeopleSummaryText(std::vector{row}), HasSubstr("1 never found"));
}

SimulatedStudioOptions TwoInASmallStudio(const std::string& motion, double seconds) {
  SimulatedStudioOptions studio = RecordedSimulation();
  studio.motion = motion;
  studio.people = 2;
  studio.width_px = 320;
  studio.height_px = 240;
  studio.seconds = seconds;
  return studio;
}

TEST(PeopleTrial, FindsTwoWhoStandApart) {
  const SimulatedStudioOptions studio = TwoInASmallStudio("stand", 1);
  const PeopleRow row = RunPeopleTrial(studio);
  EXPECT_EQ(row.never_found, 0);
  EXPECT_EQ(row.switches, 0);
  EXPECT_EQ(row.phantom_s, 0);
  EXPECT_GT(row.found_share, 0.9);
  EXPECT_LT(row.worst_person_mm, 60);
  EXPECT_EQ(RunPeopleTrial(studio).mpjpe_mm, row.mpjpe_mm);
}

class WhoStaysInPlace : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Simulated, WhoStaysInPlace, ::testing::Values("rest", "lie", "doorway"),
                         [](const auto& motion) { return std::string(motion.param); });

TEST_P(WhoStaysInPlace, IsNeitherFurnitureNorPartOfWhoWalksAround) {
  SimulatedStudioOptions studio = TwoInASmallStudio(GetParam(), 9);
  studio.fps = 10;
  const PeopleRow row = RunPeopleTrial(studio);
  EXPECT_EQ(row.never_found, 0);
  EXPECT_EQ(row.switches, 0);
  EXPECT_EQ(row.phantom_s, 0);
  EXPECT_LT(row.longest_lost_s, 0.5);
  EXPECT_LT(row.worst_person_mm, 60);
}

}  // namespace
}  // namespace mocap
