#include "tools/report/people_matching.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

constexpr std::int64_t kPeriodNs = 100;

ScoredFrame At(int frame, double x_mm, bool tracked = true) {
  ScoredFrame scored{frame * kPeriodNs, tracked, ScoredPoints::Zero()};
  scored.points_W.row(0).setConstant(x_mm);
  return scored;
}

/// Somebody who stands still over some frames.
std::vector<ScoredFrame> Still(int from, int to, double x_mm) {
  std::vector<ScoredFrame> frames;
  for (int frame = from; frame < to; ++frame) frames.push_back(At(frame, x_mm));
  return frames;
}

std::vector<int> PeopleOf(const std::vector<PersonMatch>& matches) {
  std::vector<int> people;
  for (const PersonMatch& match : matches) people.push_back(match.person);
  return people;
}

using Frames = std::vector<std::vector<ScoredFrame>>;

TEST(MatchPeople, TheNearestAreTheSame) {
  const auto matches = MatchPeople(Frames{Still(0, 3, 0), Still(0, 3, 1000)},
                                   Frames{Still(0, 3, 990), Still(0, 3, 20)});
  EXPECT_EQ(PeopleOf(matches[0]), (std::vector{1, 1, 1}));
  EXPECT_EQ(PeopleOf(matches[1]), (std::vector{0, 0, 0}));
  EXPECT_NEAR(matches[1][2].mean_mm, 20, 1e-9);
  EXPECT_EQ(matches[1][2].pose, 2);
  EXPECT_EQ(matches[1][2].frame, 2);
}

TEST(MatchPeople, NobodyIsTwoPeopleAtOnce) {
  const auto matches =
      MatchPeople(Frames{Still(0, 1, 0)}, Frames{Still(0, 1, 100), Still(0, 1, 50)});
  EXPECT_TRUE(matches[0].empty());
  EXPECT_EQ(PeopleOf(matches[1]), std::vector{0});
}

TEST(MatchPeople, WhoIsFarFromEverybodyIsNobody) {
  const auto matches = MatchPeople(Frames{Still(0, 1, 0)}, Frames{Still(0, 1, kSamePersonMm + 1)});
  EXPECT_TRUE(matches[0].empty());
}

TEST(MatchPeople, WhoIsNotTrackedIsNobody) {
  const auto matches = MatchPeople(Frames{Still(0, 1, 0)}, Frames{{At(0, 0, false)}});
  EXPECT_TRUE(matches[0].empty());
}

TEST(MatchPeople, WhoeverWasSomebodyStaysSoWhileNear) {
  // They pass each other closely: for a frame each is nearer to the other one.
  const Frames truth = {{At(0, 0), At(1, 100), At(2, 1000)}, {At(0, 1000), At(1, 110), At(2, 0)}};
  const Frames tracked = {{At(0, 0), At(1, 115), At(2, 1000)}, {At(0, 1000), At(1, 95), At(2, 0)}};
  const auto matches = MatchPeople(truth, tracked);
  EXPECT_EQ(PeopleOf(matches[0]), (std::vector{0, 0, 0}));
  EXPECT_EQ(PeopleOf(matches[1]), (std::vector{1, 1, 1}));
}

TEST(MatchPeople, WhoGoesOnAsSomebodyElseIsTold) {
  const Frames truth = {Still(0, 2, 0), Still(0, 2, 2000)};
  const auto matches = MatchPeople(truth, Frames{{At(0, 0), At(1, 2000)}});
  EXPECT_EQ(PeopleOf(matches[0]), (std::vector{0, 1}));
}

TEST(MatchPeople, FramesAreMatchedByTimeWhereverSomebodyEnters) {
  const auto matches =
      MatchPeople(Frames{Still(0, 9, 0), Still(5, 9, 1000)}, Frames{Still(4, 8, 1000)});
  EXPECT_EQ(PeopleOf(matches[0]), (std::vector{1, 1, 1}));
  EXPECT_EQ(matches[0][0].pose, 1);
  EXPECT_EQ(matches[0][0].frame, 0);
}

TEST(MatchPeople, WithoutTruthNobodyIsAnybody) {
  EXPECT_TRUE(MatchPeople(Frames{}, Frames{Still(0, 2, 0)})[0].empty());
}

}  // namespace
}  // namespace mocap
