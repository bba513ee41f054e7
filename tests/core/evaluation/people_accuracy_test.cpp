#include "core/evaluation/people_accuracy.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

ScoredPoints StandingAt(double x_mm) {
  ScoredPoints p;
  p.transpose() << 0, 0, 1700, 0, 0, 1500, 0, 180, 1450, 0, -180, 1450, 0, 480, 1450, 0, -180, 1150,
      400, 480, 1450, 0, -180, 750, 0, 100, 900, 0, -100, 900, 0, 100, 500, 0, -100, 500, 0, 100,
      50, 0, -100, 50;
  p.row(0).array() += x_mm;
  return p;
}

PresenceBySet Stands(double x_mm, int from, int to) {
  PresenceBySet person;
  for (int set = from; set < to; ++set)
    person[set] = {.points_W = StandingAt(x_mm), .whole = true, .covered = true};
  return person;
}

void Follow(double x_mm, int from, int to, PosesBySet& person) {
  for (int set = from; set < to; ++set) person[set] = StandingAt(x_mm);
}

TEST(PeopleAccuracy, OfTwoIsAsWorkedOutByHand) {
  const std::vector<PresenceBySet> truth = {Stands(0, 0, 20), Stands(2000, 0, 20)};
  std::vector<PosesBySet> followed(2);
  Follow(2030, 0, 20, followed[0]);
  Follow(10, 5, 20, followed[1]);
  const PeopleAccuracy accuracy = MeasurePeople(truth, followed, 0);
  ASSERT_EQ(accuracy.people.size(), 2u);
  const PersonAccuracy &first = accuracy.people[0], &second = accuracy.people[1];
  EXPECT_EQ(first.followed_by, 1);
  EXPECT_EQ(second.followed_by, 0);
  EXPECT_NEAR(first.distance_mm.mean, 10, 1e-9);
  EXPECT_NEAR(second.distance_mm.mean, 30, 1e-9);
  EXPECT_NEAR(accuracy.mpjpe_mm, (15 * 10 + 20 * 30) / 35.0, 1e-9);
  EXPECT_DOUBLE_EQ(first.covered_share, 0.75);
  EXPECT_EQ(first.sets_to_first, 5);
  EXPECT_EQ(first.longest_lost_sets, 0);
  EXPECT_EQ(second.sets_to_first, 0);
  EXPECT_EQ(accuracy.phantom_sets + accuracy.duplicate_sets, 0);
}

TEST(PeopleAccuracy, CountsWhoTakesOverAndHowLongNobodyFollowed) {
  std::vector<PosesBySet> followed(2);
  Follow(0, 0, 8, followed[0]);
  Follow(0, 12, 20, followed[1]);
  const PersonAccuracy accuracy =
      MeasurePeople(std::vector{Stands(0, 0, 20)}, followed, 0).people.front();
  EXPECT_EQ(accuracy.switches, 1);
  EXPECT_EQ(accuracy.longest_lost_sets, 4);
  EXPECT_DOUBLE_EQ(accuracy.covered_found_share, 0.8);
  EXPECT_DOUBLE_EQ(accuracy.covered_share, 0.4) << "one of them is his";
}

TEST(PeopleAccuracy, TwoWhoChangePlacesAreTwoSwitches) {
  const std::vector<PresenceBySet> truth = {Stands(0, 0, 20), Stands(900, 0, 20)};
  std::vector<PosesBySet> followed(2);
  Follow(0, 0, 14, followed[0]);
  Follow(900, 14, 20, followed[0]);
  Follow(900, 0, 14, followed[1]);
  Follow(0, 14, 20, followed[1]);
  const PeopleAccuracy accuracy = MeasurePeople(truth, followed, 0);
  for (const PersonAccuracy& person : accuracy.people) {
    EXPECT_EQ(person.switches, 1);
    EXPECT_DOUBLE_EQ(person.covered_found_share, 1);
    EXPECT_DOUBLE_EQ(person.covered_share, 0.7);
  }
}

TEST(PeopleAccuracy, TellsPhantomsFromDuplicates) {
  std::vector<PosesBySet> followed(3);
  Follow(0, 0, 10, followed[0]);
  Follow(200, 0, 3, followed[1]);
  Follow(-1500, 0, 6, followed[2]);
  Follow(0, 10, 12, followed[0]);  // He has left.
  const PeopleAccuracy accuracy = MeasurePeople(std::vector{Stands(0, 0, 10)}, followed, 0);
  EXPECT_EQ(accuracy.duplicate_sets, 3);
  EXPECT_EQ(accuracy.phantom_sets, 6 + 2);
  EXPECT_EQ(accuracy.people[0].followed_by, 0);
}

TEST(PeopleAccuracy, CountsOnlySettledAndCoveredSets) {
  PresenceBySet person = Stands(0, 0, 20);
  for (int set = 0; set < 4; ++set) person[set].whole = false;
  for (int set = 12; set < 20; ++set) person[set].covered = false;
  std::vector<PosesBySet> followed(1);
  Follow(100, 0, 10, followed[0]);  // Not yet settled.
  Follow(20, 10, 20, followed[0]);
  const PersonAccuracy accuracy = MeasurePeople(std::vector{person}, followed, 6).people.front();
  EXPECT_EQ(accuracy.covered_sets, 2);
  EXPECT_NEAR(accuracy.distance_mm.worst, 20, 1e-9);
}

TEST(PeopleAccuracy, OfSomebodyWhomNobodyFollowsSaysSo) {
  const PersonAccuracy accuracy =
      MeasurePeople(std::vector{Stands(0, 0, 20)}, {}, 0).people.front();
  EXPECT_EQ(accuracy.followed_by, -1);
  EXPECT_EQ(accuracy.sets_to_first, -1);
  EXPECT_EQ(accuracy.longest_lost_sets, 20);
  EXPECT_EQ(accuracy.covered_share, 0);
}

}  // namespace
}  // namespace mocap
