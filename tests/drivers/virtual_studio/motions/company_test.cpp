#include "drivers/virtual_studio/motions/company.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/errors.h"
#include "drivers/virtual_studio/room/room_plan.h"
#include "drivers/virtual_studio/scene.h"
#include "tests/support/body_capsules.h"
#include "tests/support/joint_limits.h"
#include "tests/support/setup_error.h"

namespace mocap::simulation {
namespace {

SimulatedStudioOptions Company(std::string_view motion, int people, double stature_mm = 1750,
                               std::uint64_t seed = 1) {
  SimulatedStudioOptions options;
  options.motion = motion;
  options.people = people;
  options.stature_mm = stature_mm;
  options.seed = seed;
  return options;
}

constexpr std::int64_t Ns(double t_s) { return static_cast<std::int64_t>(t_s * 1e9); }

Vector3 RightHand(const Person& person, double t_s) {
  return person.BonesAt(Ns(t_s))[kHandR] * Vector3(0, 0, -person.body().hand_mm / 2);
}

class EveryCompany : public ::testing::TestWithParam<std::tuple<std::string_view, int>> {
 protected:
  // Some companies of all sizes, and moments of half a minute.
  template <typename Check>
  void ForMoments(Check check) {
    const auto [motion, count] = GetParam();
    std::uint64_t seed = 0;
    for (const double stature_mm : {1100.0, 1750.0, 2000.0}) {
      const std::vector<Person> people = MakePeople(Company(motion, count, stature_mm, ++seed));
      for (double t_s = 0; t_s < 35; t_s += 0.13) check(people, t_s);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Simulated, EveryCompany,
                         ::testing::Combine(::testing::ValuesIn(kCompanyMotionNames),
                                            ::testing::Values(2, 3, 4)),
                         [](const auto& company) {
                           return std::string(std::get<0>(company.param)) +
                                  std::to_string(std::get<1>(company.param));
                         });

TEST_P(EveryCompany, NobodyWalksThroughAnybody) {
  ForMoments([](const std::vector<Person>& people, double t_s) {
    std::vector<std::vector<Capsule>> bodies;
    for (const Person& person : people)
      bodies.push_back(CapsulesOf(person.body(), person.BonesAt(Ns(t_s))));
    for (std::size_t i = 0; i < people.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_GT(GapBetween(bodies[i], bodies[j]), 0)
            << j << " and " << i << " of " << people[0].body().stature_mm << " mm at " << t_s;
  });
}

TEST_P(EveryCompany, StaysWithinTheLimitsOfJoints) {
  ForMoments([](const std::vector<Person>& people, double t_s) {
    for (const Person& person : people) ExpectWithinLimits(person.motion().PoseAt(t_s), t_s);
  });
}

TEST_P(EveryCompany, StaysInTheRoomButForVisitors) {
  const std::string_view motion = std::get<0>(GetParam());
  ForMoments([&](const std::vector<Person>& people, double t_s) {
    const std::size_t first = motion == "doorway" ? 1 : 0;
    const std::size_t end = motion == "visit" ? people.size() / 2 : people.size();
    for (std::size_t i = first; i < end; ++i) {
      for (const Vector3& p_W : PointsOf(people[i].body(), people[i].BonesAt(Ns(t_s)))) {
        ASSERT_LT(p_W.head<2>().cwiseAbs().maxCoeff(), 2250) << t_s;
        ASSERT_GT(p_W.z(), 0) << t_s;
      }
    }
  });
}

TEST_P(EveryCompany, MovesWithoutJerks) {
  constexpr double kStep_s = 0.005, kMost_mm_s2 = 30 * 9810;
  const auto [motion, count] = GetParam();
  for (const Person& person : MakePeople(Company(motion, count))) {
    const auto points = [&](int i) {
      return PointsOf(person.body(),
                      PlaceBones(person.body(), person.motion().PoseAt(i * kStep_s)));
    };
    TruePoints before = points(0), now = points(1);
    for (int i = 2; i < 2400; ++i) {
      const TruePoints after = points(i);
      for (int k = 0; k < kTruthPointCount; ++k)
        ASSERT_LT((after[k] - 2 * now[k] + before[k]).norm() / (kStep_s * kStep_s), kMost_mm_s2)
            << kTruthPointNames[k] << " at " << i * kStep_s << " s";
      before = now;
      now = after;
    }
  }
}

TEST(Company, WalkersCrossEachOthersWayShortlyAfterEachOther) {
  constexpr double kStep_s = 0.05;
  for (const int count : {2, 3, 4}) {
    const std::vector<Person> people = MakePeople(Company("walk", count));
    const auto place = [&](int person, int i) -> Vector2 {
      return people[person].BonesAt(Ns(i * kStep_s))[kPelvis].p.head<2>();
    };
    // Somebody is where another was at most 2 s before, and goes across his way.
    int crossings = 0;
    for (int i = 40; i < 600; ++i) {
      const Vector2 here = place(0, i), way = place(0, i + 1) - here;
      for (int j = i - 40; j < i; ++j) {
        const Vector2 there = place(1, j), other = place(1, j + 1) - there;
        const bool is_across =
            std::abs(way.normalized().dot(other.normalized())) < std::cos(60 * kDegree);
        crossings += is_across && (here - there).norm() < 30;
      }
    }
    EXPECT_GE(crossings, 3) << count;
  }
}

TEST(Company, HandsMeetPalmToPalm) {
  for (const double stature_mm : {1100.0, 1750.0, 2000.0}) {
    for (const int count : {2, 4}) {
      for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const std::vector<Person> people = MakePeople(Company("meet", count, stature_mm, seed));
        for (std::size_t i = 0; i < people.size(); i += 2) {
          double together_s = 0, farthest_mm = 0, nearest_mm = 1e9;
          for (double t_s = 0; t_s < 14; t_s += 0.05) {
            const double mm = (RightHand(people[i], t_s) - RightHand(people[i + 1], t_s)).norm();
            nearest_mm = std::min(nearest_mm, mm);
            farthest_mm = std::max(farthest_mm, mm);
            together_s += mm < 40 ? 0.05 : 0;
          }
          // As far apart as palms are thick, for a good while; and parted.
          EXPECT_GT(nearest_mm, 20) << stature_mm << ' ' << seed;
          EXPECT_GT(together_s, 1.5) << stature_mm << ' ' << seed;
          EXPECT_GT(farthest_mm, 2000) << stature_mm << ' ' << seed;
        }
      }
    }
  }
}

TEST(Company, VisitorsComeAndGoOneByOneWhileOthersStay) {
  const Scene scene(Company("visit", 4));
  struct Stay {
    double first_s = 1e9, last_s = -1;
  };
  std::array<Stay, 4> stays;
  for (int i = 0; i < 4; ++i) {
    for (double t_s = 0; t_s < 22; t_s += 0.1) {
      if (!scene.PresenceOf(i, Ns(t_s)).in_room) continue;
      stays[i].first_s = std::min(stays[i].first_s, t_s);
      stays[i].last_s = t_s;
    }
    for (double t_s = stays[i].first_s + 1; t_s < stays[i].last_s - 1; t_s += 0.5)
      ASSERT_TRUE(scene.PresenceOf(i, Ns(t_s)).whole) << i << " at " << t_s;
  }
  for (const int staying : {0, 1}) {
    EXPECT_EQ(stays[staying].first_s, 0);
    EXPECT_GT(stays[staying].last_s, 21.8);
  }
  EXPECT_GT(stays[2].first_s, 2);
  EXPECT_GT(stays[3].first_s, stays[2].first_s + 2);
  EXPECT_GT(stays[2].last_s, stays[3].first_s + 2) << "both are there for a while";
  EXPECT_GT(stays[3].last_s, stays[2].last_s + 2);
  EXPECT_LT(stays[3].last_s, 21.5);
}

TEST(Company, WhoRestsSitsStillForAMinuteWhileOthersWalk) {
  const std::vector<Person> people = MakePeople(Company("rest", 2));
  const auto points = [&](int i, double t_s) {
    return PointsOf(people[i].body(), people[i].BonesAt(Ns(t_s)));
  };
  const TruePoints first = points(0, 4);
  for (double t_s = 4; t_s < 63; t_s += 0.5) {
    const TruePoints now = points(0, t_s);
    for (int k = 0; k < kTruthPointCount; ++k)
      ASSERT_LT((now[k] - first[k]).norm(), 10) << kTruthPointNames[k] << " at " << t_s;
  }
  EXPECT_GT((points(1, 5)[0] - points(1, 4)[0]).norm(), 500);
  EXPECT_GT(points(0, 67)[0].z(), first[0].z() + 300) << "and stands up";
}

TEST(Company, WhoLiesStaysOnTheFloorForAMinuteWhileOthersWalk) {
  const std::vector<Person> people = MakePeople(Company("lie", 2));
  const auto points = [&](int i, double t_s) {
    return PointsOf(people[i].body(), people[i].BonesAt(Ns(t_s)));
  };
  const TruePoints first = points(0, 6);
  for (const Vector3& p_W : first) EXPECT_LT(p_W.z(), 350);
  for (double t_s = 6; t_s < 64; t_s += 0.5) EXPECT_EQ(points(0, t_s), first) << "at " << t_s;
  EXPECT_GT((points(1, 7)[0] - points(1, 6)[0]).norm(), 500);
  EXPECT_GT(points(0, 71)[0].z(), first[0].z() + 700) << "and gets up";
}

TEST(Company, WhoStandsInTheDoorwayIsHalfOutside) {
  const std::vector<Person> people = MakePeople(Company("doorway", 2));
  int outside = 0, inside = 0;
  for (const Vector3& p_W : PointsOf(people[0].body(), people[0].BonesAt(Ns(3))))
    ++(p_W.x() < kDoorX_mm ? outside : inside);
  EXPECT_GT(outside, 2);
  EXPECT_GT(inside, 2);
}

TEST(Company, OneAloneMovesAsEver) {
  const Anthropometry body = MakeAnthropometry(1600, 7);
  for (const std::string_view name : kMotionNames) {
    const auto company = MakeCompany(name, std::array{body}, 7);
    ASSERT_EQ(company.size(), 1u);
    const BodyPose pose = company[0]->PoseAt(3.7),
                   expected = MakeMotion(name, body, 7)->PoseAt(3.7);
    EXPECT_EQ(pose.p_WPelvis, expected.p_WPelvis) << name;
    EXPECT_EQ(pose.R_WPelvis, expected.R_WPelvis) << name;
  }
}

TEST(Company, OthersAreOtherPeopleOfTheSameAge) {
  const Scene scene(Company("stand", 4, 1200));
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(scene.people()[i].body().stature_mm, 1200, 97);
    for (int j = 0; j < i; ++j) {
      EXPECT_NE(scene.people()[i].body().stature_mm, scene.people()[j].body().stature_mm);
      EXPECT_NE(scene.figures()[i].outfit.trouser_slack_mm,
                scene.figures()[j].outfit.trouser_slack_mm);
    }
  }
}

TEST(Company, RefusesWhatCannotBeDone) {
  const std::vector<Anthropometry> bodies(2, MakeAnthropometry(1750, 1));
  EXPECT_THROW(MakeCompany("fly", bodies, 1), SetupError);
  for (const std::string name : {"meet", "doorway"}) {
    EXPECT_EQ(testing::SetupErrorOf([&] { MakeCompany(name, std::span(bodies).first(1), 1); }),
              "motion \"" + name + "\" needs 2 people or more; people is 1");
  }
  EXPECT_THROW(MakePeople(Company("walk", 0)), SetupError);
  EXPECT_THROW(MakePeople(Company("walk", kMostSimulatedPeople + 1)), SetupError);
}

}  // namespace
}  // namespace mocap::simulation
