#include "tools/accuracy/paired_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mocap {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

ScoreRow Row(const std::string& group, const std::string& person, int first, double mean_mm) {
  return {"variety", group, person, first, PoseErrors{mean_mm, 2 * mean_mm, 3}, 1};
}

/// Twenty people with errors from 30 to 68 mm, and what each error becomes.
std::vector<ScoreRow> People(double (*change)(int person, double mean_mm),
                             const std::string& group = "30 Hz") {
  std::vector<ScoreRow> rows;
  for (int person = 0; person < 20; ++person)
    rows.push_back(Row(group, std::to_string(person), 0, change(person, 30 + 2 * person)));
  return rows;
}

double Same(int /*person*/, double mean_mm) { return mean_mm; }

PairedDifference Only(const PairedComparison& comparison) {
  EXPECT_EQ(comparison.differences.size(), 1u);
  return comparison.differences.front();
}

TEST(PairedComparison, WhatHelpsMostPeopleIsBetterAndTheOppositeIsWorse) {
  // All gain from 0.5 to 1.5 mm, which their own differences of 38 mm would hide.
  const auto helps = [](int person, double mean_mm) { return mean_mm - 0.5 - person % 3 * 0.5; };
  const std::vector<ScoreRow> before = People(Same), after = People(helps);
  const PairedDifference difference = Only(ComparePaired(before, after));
  EXPECT_EQ(difference.people, 20);
  EXPECT_DOUBLE_EQ(difference.before_mm, 49);
  EXPECT_NEAR(difference.difference_mm(), -0.975, 1e-9);
  EXPECT_LT(difference.low_mm, difference.difference_mm());
  EXPECT_GT(difference.high_mm, difference.difference_mm());
  // Of a mean of 20 with a standard deviation of 0.41 mm.
  EXPECT_NEAR(difference.high_mm - difference.low_mm, 2 * 1.96 * 0.41 / 4.47, 0.03);
  EXPECT_EQ(difference.conclusion(), PairedConclusion::kBetter);
  EXPECT_EQ(Only(ComparePaired(after, before)).conclusion(), PairedConclusion::kWorse);
}

TEST(PairedComparison, WhatHelpsOneAsMuchAsItHarmsAnotherIsNoDifference) {
  const auto exchanges = [](int person, double mean_mm) {
    return mean_mm + (person % 2 == 0 ? 20 : -20);
  };
  const std::vector<ScoreRow> before = People(Same), after = People(exchanges);
  EXPECT_EQ(Only(ComparePaired(before, after)).conclusion(), PairedConclusion::kNoDifference);
  EXPECT_EQ(Only(ComparePaired(before, before)).conclusion(), PairedConclusion::kNoDifference);
}

TEST(PairedComparison, FivePeopleAreTooFewForAConclusion) {
  std::vector<ScoreRow> before = People(Same);
  before.resize(5);
  std::vector<ScoreRow> after = before;
  for (ScoreRow& row : after) row.errors->mean_mm -= 10;
  EXPECT_EQ(Only(ComparePaired(before, after)).conclusion(), PairedConclusion::kTooFew);
}

TEST(PairedComparison, RunsOfAPersonCountAsOne) {
  // Somebody with eight runs weighs no more than others.
  std::vector<ScoreRow> before = People(Same), after = before;
  for (int first = 1; first < 8; ++first) {
    before.push_back(Row("30 Hz", "0", first, 30));
    after.push_back(Row("30 Hz", "0", first, 30 + 20));
  }
  const PairedDifference difference = Only(ComparePaired(before, after));
  EXPECT_EQ(difference.people, 20);
  EXPECT_NEAR(difference.difference_mm(), 20.0 * 7 / 8 / 20, 1e-9);
}

TEST(PairedComparison, APersonInTwoGroupsIsOnePersonInAllOfThem) {
  std::vector<ScoreRow> before = People(Same), after = People(Same);
  const std::vector<ScoreRow> slow = People(Same, "10 Hz");
  before.insert(before.end(), slow.begin(), slow.end());
  after.insert(after.end(), slow.begin(), slow.end());
  const PairedComparison comparison = ComparePaired(before, after);
  ASSERT_EQ(comparison.differences.size(), 3u);
  EXPECT_EQ(comparison.differences[0].label, "variety, 10 Hz");
  EXPECT_EQ(comparison.differences[2].label, "variety");
  EXPECT_EQ(comparison.differences[2].people, 20);
}

TEST(PairedComparison, WhatHasNoPartnerIsToldAndNotCompared) {
  std::vector<ScoreRow> before = People(Same), after = People(Same);
  before.erase(before.begin());  // Person 0 is only after,
  after.pop_back();              // person 19 only before,
  after[1].errors.reset();       // and person 1 is no longer tracked.
  after[1].tracked_share = 0;
  const PairedComparison comparison = ComparePaired(before, after);
  EXPECT_EQ(Only(comparison).people, 17);
  EXPECT_NEAR(Only(comparison).share_after, 17.0 / 18, 1e-9);
  EXPECT_THAT(ComparisonText(comparison),
              AllOf(HasSubstr("1 row only before: variety 30 Hz 19 from set 0\n"),
                    HasSubstr("1 row only after: variety 30 Hz 0 from set 0\n"),
                    HasSubstr("1 row tracked only before: variety 30 Hz 1 from set 0\n"),
                    Not(HasSubstr("tracked only after"))));
}

TEST(PairedComparison, TheSameRowsGiveTheSameIntervals) {
  const auto helps = [](int person, double mean_mm) { return mean_mm - person % 3; };
  const std::vector<ScoreRow> before = People(Same), after = People(helps);
  EXPECT_EQ(ComparisonText(ComparePaired(before, after)),
            ComparisonText(ComparePaired(before, after)));
}

}  // namespace
}  // namespace mocap
