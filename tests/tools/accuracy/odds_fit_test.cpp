#include "tools/accuracy/odds_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr double kTemperature = 0.2;

// Nats of a term, and none in all others.
OddsFrame::Nats NatsOf(Term term, double nats) {
  OddsFrame::Nats all{};
  all[static_cast<std::size_t>(term)] = nats;
  return all;
}

// Sets with four poses at random costs, one of which is right as often as the odds say.
OddsTake DrawnOdds(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> nats(0, 40);
  OddsTake take;
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 4> costs;
    for (double& cost : costs) cost = nats(random);
    std::array<double, 4> weights;
    for (std::size_t k = 0; k < costs.size(); ++k) weights[k] = std::exp(-kTemperature * costs[k]);
    const std::size_t right =
        std::discrete_distribution<std::size_t>(weights.begin(), weights.end())(random);
    OddsFrame& frame = take.emplace_back();
    for (std::size_t k = 0; k < costs.size(); ++k)
      (k == right ? frame.right : frame.wrong).push_back(NatsOf(Term::kRays, costs[k]));
  }
  return take;
}

TEST(FitOdds, FindsTheFactorThatPosesWereDrawnWith) {
  const MeasuredOdds odds = FitOdds(std::vector{DrawnOdds(1), DrawnOdds(2)});
  EXPECT_EQ(odds.frames, 40000);
  EXPECT_NEAR(odds.temperature, kTemperature, 0.005);
  EXPECT_NEAR(odds.others_nats, odds.own_nats, 1e-3);
  for (const MeasuredOdds::Bin& bin : odds.bins) {
    EXPECT_GT(bin.frames, 1000);
    EXPECT_GT(bin.predicted, bin.from);
    EXPECT_LT(bin.predicted, bin.to);
    EXPECT_NEAR(bin.predicted, bin.right_share, 0.02);
  }
}

TEST(FitOdds, TheRightPoseOfASetIsTheRightOneWithTheFewestNats) {
  const OddsFrame leads{{NatsOf(Term::kRays, 50), NatsOf(Term::kRays, 2)},
                        {NatsOf(Term::kRays, 9), NatsOf(Term::kRays, 12)}};
  const OddsFrame trails{{NatsOf(Term::kRays, 3)}, {NatsOf(Term::kRays, 1)}};
  const MeasuredOdds odds = FitOdds(std::vector<OddsTake>{{leads, trails}, {leads}});
  EXPECT_EQ(odds.frames, 3);
  EXPECT_NEAR(odds.right_share, 2.0 / 3, 1e-12);
  EXPECT_NEAR(odds.median_lead_nats, 7, 1e-12);
}

TEST(FitOdds, ATermThatDecidesIsMissed) {
  OddsFrame frame{{NatsOf(Term::kRays, 0)}, {NatsOf(Term::kRays, 10)}};
  frame.right[0][static_cast<std::size_t>(Term::kFlesh)] = 4;
  const MeasuredOdds odds = FitOdds(std::vector<OddsTake>{{frame}, {frame}});
  EXPECT_EQ(odds.right_share, 1);
  EXPECT_EQ(odds.right_share_without[static_cast<std::size_t>(Term::kRays)], 0);
  EXPECT_EQ(odds.right_share_without[static_cast<std::size_t>(Term::kFlesh)], 1);
}

TEST(FitOdds, HugeLeadsDoNotOverflow) {
  const OddsFrame leads{{NatsOf(Term::kRays, 0)}, {NatsOf(Term::kRays, 1e5)}};
  const OddsFrame trails{{NatsOf(Term::kRays, 1e5)}, {NatsOf(Term::kRays, 0)}};
  const MeasuredOdds odds = FitOdds(std::vector<OddsTake>{{leads, trails}, {leads, trails}});
  EXPECT_TRUE(std::isfinite(odds.others_nats));
  EXPECT_TRUE(std::isfinite(odds.own_nats));
}

TEST(OddsTables, ListEveryTermAndNeedBothHalves) {
  const std::vector<OddsTake> takes = {DrawnOdds(1), DrawnOdds(2)};
  for (const std::string_view name : kTermNames)
    EXPECT_THAT(OddsTables(takes), HasSubstr("\n| " + std::string(name) + " | "));
  EXPECT_EQ(OddsTables(std::vector<OddsTake>{takes[0], {}}), "");
}

}  // namespace
}  // namespace mocap
