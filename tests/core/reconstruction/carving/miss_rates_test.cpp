#include "core/reconstruction/carving/miss_rates.h"

#include <gtest/gtest.h>

#include "tests/core/reconstruction/synthetic_studio.h"

namespace mocap {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::uint64_t First(int cameras) { return (std::uint64_t{1} << cameras) - 1; }

std::vector<DrawnCapsule> ThreePeople() {
  std::vector<DrawnCapsule> all;
  for (const Vector2& at : {Vector2(-900, 300), Vector2(500, -700), Vector2(600, 800)}) {
    for (const DrawnCapsule& part : StandingPerson(at.x(), at.y())) all.push_back(part);
  }
  return all;
}

TEST(MissRates, GoodSilhouettesMissNobodyWhateverTheNumberOfCameras) {
  for (const int cameras : {4, 6, 8, 16}) {
    for (const bool several : {false, true}) {
      SCOPED_TRACE(::testing::Message() << cameras << " cameras, several people: " << several);
      SyntheticStudio studio(cameras);
      studio.Show(several ? ThreePeople() : StandingPerson(0, 0));
      std::vector<CarvingView> views = studio.Views();
      MissRates rates(views.size(), several);
      rates.Weigh(views, First(cameras), 0);
      for (int c = 0; c < cameras; ++c) {
        EXPECT_LT(rates.Of(c).value(), 0.08) << c;
        EXPECT_GE(views[static_cast<std::size_t>(c)].outweighed_by, std::min(cameras, 8)) << c;
      }
    }
  }
}

TEST(MissRates, FewOthersOutweighCamerasThatMissLegs) {
  SyntheticStudio studio(16);
  studio.Show(StandingPerson(0, 0));
  for (const std::size_t misled : {3u, 4u}) EraseLegs(studio.silhouettes[misled]);
  std::vector<CarvingView> views = studio.Views();
  MissRates rates(views.size(), false);
  rates.Weigh(views, First(16), 0);
  for (std::size_t c = 0; c < 16; ++c) {
    const bool is_misled = c == 3 || c == 4;
    EXPECT_NEAR(rates.Of(static_cast<int>(c)).value(), is_misled ? 0.5 : 0, is_misled ? 0.2 : 0.03)
        << c;
    EXPECT_EQ(views[c].outweighed_by <= 3, is_misled) << c;
  }
}

TEST(MissRates, WhatACameraDoesNotKnowItDoesNotMiss) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  studio.unknown[2] = studio.silhouettes[2];
  EraseLegs(studio.silhouettes[2]);
  std::vector<CarvingView> views = studio.Views();
  MissRates rates(views.size(), false);
  rates.Weigh(views, First(8), 0);
  EXPECT_LT(rates.Of(2).value(), 0.03);
}

TEST(MissRates, LookOnceASecondAndForgetAfterFour) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  const Silhouette good = studio.silhouettes[2];
  MissRates rates(8, false);
  const auto weigh = [&](std::int64_t capture_ns) {
    std::vector<CarvingView> views = studio.Views();
    rates.Weigh(views, First(8), capture_ns);
    return views[2].outweighed_by;
  };
  EXPECT_EQ(weigh(0), kNeverOutweighed);
  EraseLegs(studio.silhouettes[2]);
  EXPECT_EQ(weigh(kSecond_ns / 2), kNeverOutweighed);
  EXPECT_LT(weigh(kSecond_ns), 7);
  studio.silhouettes[2] = good;
  EXPECT_LT(weigh(2 * kSecond_ns), 7);
  for (int second = 3; second < 6; ++second) weigh(second * kSecond_ns);
  EXPECT_EQ(weigh(6 * kSecond_ns), kNeverOutweighed);
}

TEST(MissRates, LookAgainWhenTheClockIsSetBack) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  MissRates rates(8, false);
  std::vector<CarvingView> views = studio.Views();
  rates.Weigh(views, First(8), 3600 * kSecond_ns);
  EraseLegs(studio.silhouettes[2]);
  views = studio.Views();
  rates.Weigh(views, First(8), 0);
  EXPECT_LT(views[2].outweighed_by, 7);
}

TEST(MissRates, NobodyOnTheStageChangesNothing) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  EraseLegs(studio.silhouettes[2]);
  MissRates rates(8, false);
  std::vector<CarvingView> views = studio.Views();
  rates.Weigh(views, First(8), 0);
  const std::optional<double> before = rates.Of(2);
  studio.Show({});
  views = studio.Views();
  for (int second = 1; second < 9; ++second) rates.Weigh(views, First(8), second * kSecond_ns);
  EXPECT_EQ(rates.Of(2), before);
}

TEST(MissRates, ACameraThatIsNotInTheSetKeepsItsRate) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  EraseLegs(studio.silhouettes[2]);
  MissRates rates(8, false);
  std::vector<CarvingView> views = studio.Views();
  rates.Weigh(views, First(8), 0);
  views.erase(views.begin());
  rates.Weigh(views, First(8) & ~std::uint64_t{1}, kSecond_ns);
  EXPECT_LE(views[1].outweighed_by, 5);
  EXPECT_GT(rates.Of(2).value(), 0.2);
  EXPECT_LT(rates.Of(3).value(), 0.03);
}

TEST(MissRates, ASingleSetIsWeighedAlike) {
  SyntheticStudio studio(8);
  studio.Show(StandingPerson(0, 0));
  EraseLegs(studio.silhouettes[2]);
  std::vector<CarvingView> once = studio.Views(), views = studio.Views();
  MissRates(8, false).Weigh(views, First(8), 0);
  WeighOnce(once, false);
  for (std::size_t c = 0; c < 8; ++c) EXPECT_EQ(once[c].outweighed_by, views[c].outweighed_by) << c;
}

TEST(MissRates, ThreeCamerasCannotTellWhoIsWrong) {
  SyntheticStudio studio(3);
  studio.Show(StandingPerson(0, 0));
  EraseLegs(studio.silhouettes[2]);
  MissRates rates(3, false);
  std::vector<CarvingView> views = studio.Views();
  rates.Weigh(views, First(3), 0);
  EXPECT_FALSE(rates.Of(2));
  EXPECT_EQ(views[2].outweighed_by, kNeverOutweighed);
}

}  // namespace
}  // namespace mocap
