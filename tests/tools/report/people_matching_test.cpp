#include "tools/report/people_matching.h"

#include <gtest/gtest.h>

namespace mocap {
namespace {

constexpr std::int64_t kFrameNs = 100;

ScoredFrame At(int frame, double x_mm, bool tracked = true) {
  ScoredFrame scored{frame * kFrameNs, tracked, ScoredPoints::Zero()};
  scored.points_W.row(0).setConstant(x_mm);
  return scored;
}

/// Somebody who stands still over some frames.
std::vector<ScoredFrame> Still(int from, int to, double x_mm) {
  std::vector<ScoredFrame> frames;
  for (int frame = from; frame < to; ++frame) frames.push_back(At(frame, x_mm));
  return frames;
}

std::vector<int> PeopleOf(const MatchedPerson& person) {
  std::vector<int> people;
  for (const PersonMatch& match : person.matches) people.push_back(match.person);
  return people;
}

using Frames = std::vector<std::vector<ScoredFrame>>;

TEST(MatchPeople, TheNearestAreTheSame) {
  const auto people = MatchPeople(Frames{Still(0, 3, 0), Still(0, 3, 1000)},
                                  Frames{Still(0, 3, 990), Still(0, 3, 20)});
  EXPECT_EQ(PeopleOf(people[0]), (std::vector{1, 1, 1}));
  EXPECT_EQ(PeopleOf(people[1]), (std::vector{0, 0, 0}));
  EXPECT_NEAR(people[1].matches[2].mean_mm, 20, 1e-9);
  EXPECT_EQ(people[1].matches[2].pose, 2);
  EXPECT_EQ(people[1].matches[2].frame, 2);
}

TEST(MatchPeople, NobodyIsTwoPeopleAtOnce) {
  const auto people =
      MatchPeople(Frames{Still(0, 1, 0)}, Frames{Still(0, 1, 100), Still(0, 1, 50)});
  EXPECT_TRUE(people[0].matches.empty());
  EXPECT_EQ(PeopleOf(people[1]), std::vector{0});
  EXPECT_EQ(people[0].duplicates, 1);
  EXPECT_EQ(people[1].duplicates, 0);
}

TEST(MatchPeople, AFrameIsMatchedOnceThoughTwoPosesAreNearInTime) {
  std::vector<ScoredFrame> early = Still(0, 3, 10), late = Still(0, 3, 0);
  for (ScoredFrame& frame : late) frame.timestamp_ns += kFrameNs / 4;
  const auto people = MatchPeople(Frames{Still(0, 3, 0)}, Frames{early, late});
  EXPECT_EQ(people[0].matches.size(), 3u);
  EXPECT_TRUE(people[1].matches.empty());
  EXPECT_EQ(people[1].duplicates, 3);
}

TEST(MatchPeople, WhoIsFarFromEverybodyIsNobody) {
  const auto people = MatchPeople(Frames{Still(0, 1, 0)}, Frames{Still(0, 1, kSamePersonMm + 1)});
  EXPECT_EQ(people[0].duplicates, 0);
  EXPECT_TRUE(people[0].matches.empty());
}

TEST(MatchPeople, WhoIsNotTrackedIsNobody) {
  const auto people = MatchPeople(Frames{Still(0, 1, 0)}, Frames{{At(0, 0, false)}});
  EXPECT_TRUE(people[0].matches.empty());
}

TEST(MatchPeople, WhoeverWasSomebodyStaysSoWhileNear) {
  // They pass each other closely: for a frame each is nearer to the other one.
  const Frames truth = {{At(0, 0), At(1, 100), At(2, 1000)}, {At(0, 1000), At(1, 110), At(2, 0)}};
  const Frames tracked = {{At(0, 0), At(1, 115), At(2, 1000)}, {At(0, 1000), At(1, 95), At(2, 0)}};
  const auto people = MatchPeople(truth, tracked);
  EXPECT_EQ(PeopleOf(people[0]), (std::vector{0, 0, 0}));
  EXPECT_EQ(PeopleOf(people[1]), (std::vector{1, 1, 1}));
}

TEST(MatchPeople, WhoGoesOnAsSomebodyElseIsTold) {
  const Frames truth = {Still(0, 2, 0), Still(0, 2, 2000)};
  const auto people = MatchPeople(truth, Frames{{At(0, 0), At(1, 2000)}});
  EXPECT_EQ(PeopleOf(people[0]), (std::vector{0, 1}));
}

TEST(MatchPeople, FramesAreMatchedByTimeWhereverSomebodyEnters) {
  const auto people =
      MatchPeople(Frames{Still(0, 9, 0), Still(5, 9, 1000)}, Frames{Still(4, 8, 1000)});
  EXPECT_EQ(PeopleOf(people[0]), (std::vector{1, 1, 1}));
  EXPECT_EQ(people[0].matches[0].pose, 1);
  EXPECT_EQ(people[0].matches[0].frame, 0);
}

TEST(MatchPeople, WithoutTruthNobodyIsAnybody) {
  EXPECT_TRUE(MatchPeople(Frames{}, Frames{Still(0, 2, 0)})[0].matches.empty());
}

}  // namespace
}  // namespace mocap
