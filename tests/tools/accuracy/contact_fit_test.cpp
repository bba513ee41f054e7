#include "tools/accuracy/contact_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocap {
namespace {

/// Feet that touch the floor with the probability that the odds give.
std::vector<ContactSample> SamplesOf(const ContactOdds& odds, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> height_mm(0, 120), speed_mm_s(0, 2000), share(0, 1);
  std::vector<ContactSample> samples;
  for (int i = 0; i < count; ++i) {
    const FootMotion motion{height_mm(random), speed_mm_s(random)};
    const double nats = odds.resting + odds.per_mm * motion.height_mm +
                        odds.per_log_speed * std::log1p(motion.speed_mm_s / kStandingSpeed_mm_s);
    samples.push_back({motion, share(random) < 1 / (1 + std::exp(-nats))});
  }
  return samples;
}

TEST(ContactFit, FindsTheOddsThatSamplesWereDrawnFrom) {
  const ContactOdds truth{5, -0.05, -1.2};
  const ContactOdds fitted = FitContactOdds(SamplesOf(truth, 20000, 1));
  // Four standard deviations of the estimates over forty seeds.
  EXPECT_NEAR(fitted.resting, truth.resting, 0.45);
  EXPECT_NEAR(fitted.per_mm, truth.per_mm, 0.005);
  EXPECT_NEAR(fitted.per_log_speed, truth.per_log_speed, 0.1);
}

TEST(ContactFit, OddsOfPartsThatMotionTellsApartStayFinite) {
  const ContactOdds odds = FitContactOdds(
      std::vector<ContactSample>{{{0, 0}, true}, {{100, 1000}, false}, {{5, 10}, true}});
  EXPECT_TRUE(std::isfinite(odds.resting + odds.per_mm + odds.per_log_speed));
}

TEST(ContactFit, TheTableChecksAtOtherPeopleThanItFits) {
  const ContactOdds odds{5, -0.05, -1.2};
  const std::vector<ContactTake> takes = {{SamplesOf(odds, 300, 1), SamplesOf(odds, 200, 2)},
                                          {SamplesOf(odds, 100, 3), SamplesOf(odds, 100, 4)}};
  const std::string table = ContactTable(takes);
  EXPECT_THAT(table, ::testing::ContainsRegex("\n\\| heel \\|.*\\| 300 \\|"));
  EXPECT_THAT(table, ::testing::ContainsRegex("\n\\| toes \\|.*\\| 200 \\|"));
}

}  // namespace
}  // namespace mocap
