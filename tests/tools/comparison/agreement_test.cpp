#include "tools/comparison/agreement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocap {
namespace {

TEST(Agreement, IsAsByHand) {
  const double differences[] = {1, 2, std::nan(""), 3, 6};
  const Agreement agreement = AgreementOf(differences);
  EXPECT_EQ(agreement.count, 4u);
  EXPECT_DOUBLE_EQ(agreement.bias, 3);
  EXPECT_DOUBLE_EQ(agreement.rmsd, std::sqrt(50.0 / 4));
  EXPECT_DOUBLE_EQ(agreement.deviation, std::sqrt(14.0 / 3));
  EXPECT_DOUBLE_EQ(agreement.rmsd_without_bias, std::sqrt(14.0 / 4));
  EXPECT_DOUBLE_EQ(agreement.upper - agreement.lower, 2 * 1.96 * agreement.deviation);
  EXPECT_DOUBLE_EQ((agreement.upper + agreement.lower) / 2, agreement.bias);
}

TEST(Agreement, SquaresOfBiasAndRestAddUp) {
  const double differences[] = {-4, 7.5, 2, 0.25, -1};
  const Agreement agreement = AgreementOf(differences);
  EXPECT_NEAR(std::pow(agreement.rmsd, 2),
              std::pow(agreement.bias, 2) + std::pow(agreement.rmsd_without_bias, 2), 1e-12);
}

TEST(Agreement, OfNothingIsUnknown) {
  EXPECT_EQ(AgreementOf({}).count, 0u);
  EXPECT_TRUE(std::isnan(AgreementOf({}).rmsd));
}

TEST(Correlation, IgnoresScaleAndOffsetButMultipleCorrelationDoesNot) {
  std::vector<double> a, same, scaled, shifted;
  for (int i = 0; i < 50; ++i) {
    a.push_back(std::sin(0.3 * i));
    scaled.push_back(-3 * a.back() + 5);
    shifted.push_back(a.back() + 0.5);
  }
  EXPECT_NEAR(CorrelationOf(a, scaled), -1, 1e-12);
  EXPECT_NEAR(CorrelationOf(a, shifted), 1, 1e-12);
  EXPECT_NEAR(MultipleCorrelationOf(a, a), 1, 1e-12);
  EXPECT_LT(MultipleCorrelationOf(a, shifted), 0.95);
  EXPECT_TRUE(std::isnan(CorrelationOf(a, std::vector<double>(50, 2.0))));
}

}  // namespace
}  // namespace mocap
