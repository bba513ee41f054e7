#include "core/objective/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocap {
namespace {

constexpr ResidualNoise kSkewed{.freedom = 2.5, .inside_mm = 7, .outside_mm = 19, .alike = 3};

TEST(ResidualNoise, WeighsAResidualByTheSlopeOfItsCost) {
  for (const double freedom : {1.0, 2.5, 10.0}) {
    ResidualNoise noise = kSkewed;
    noise.freedom = freedom;
    for (const double residual_mm : {-140.0, -30.0, -7.0, -0.5, 0.5, 7.0, 30.0, 140.0}) {
      constexpr double kSmall_mm = 1e-4;
      const double slope =
          (noise.NatsAt(residual_mm + kSmall_mm) - noise.NatsAt(residual_mm - kSmall_mm)) /
          (2 * kSmall_mm);
      EXPECT_NEAR(noise.VarianceAt(residual_mm) * slope / residual_mm, 1, 1e-6) << residual_mm;
    }
  }
}

TEST(ResidualNoise, CostsNothingAtTheSurfaceAndMoreTheFartherAway) {
  EXPECT_EQ(kSkewed.NatsAt(0), 0);
  for (const double side : {-1.0, 1.0}) {
    for (double residual_mm = 0; residual_mm < 200; residual_mm += 10)
      EXPECT_LT(kSkewed.NatsAt(side * residual_mm), kSkewed.NatsAt(side * (residual_mm + 10)));
  }
}

TEST(ResidualNoise, CostsMoreOnTheSideWhereResidualsAreSmall) {
  EXPECT_GT(kSkewed.NatsAt(-15), kSkewed.NatsAt(15));
  EXPECT_LT(kSkewed.VarianceAt(-15), kSkewed.VarianceAt(15));
}

// Of a residual that is many times as large as usual, more of the same tells hardly anything.
TEST(ResidualNoise, PullsByAnOutlierLessThanByANeighbour) {
  const auto pull = [](double residual_mm) {
    return std::abs(residual_mm) / kSkewed.VarianceAt(residual_mm);
  };
  EXPECT_LT(pull(140), pull(20));
  EXPECT_LT(pull(-140), pull(-20));
}

TEST(ResidualNoise, OfManyFreedomsIsNormal) {
  const ResidualNoise normal{.freedom = 1e9, .inside_mm = 10, .outside_mm = 20, .alike = 1};
  EXPECT_NEAR(normal.NatsAt(-15), 15.0 * 15 / (2 * 10 * 10), 1e-6);
  EXPECT_NEAR(normal.NatsAt(15), 15.0 * 15 / (2 * 20 * 20), 1e-6);
  EXPECT_NEAR(normal.VarianceAt(15), 20 * 20, 1e-3);
}

TEST(ResidualNoise, OfNeighboursThatErrAlikeCountsAsOne) {
  ResidualNoise single = kSkewed;
  single.alike = 1;
  EXPECT_DOUBLE_EQ(kSkewed.alike * kSkewed.NatsAt(12), single.NatsAt(12));
  EXPECT_DOUBLE_EQ(kSkewed.VarianceAt(12), kSkewed.alike * single.VarianceAt(12));
}

TEST(ResidualNoise, AboutAnUncertainPoseIsWiderByThePosesVariance) {
  const ResidualNoise wider = kSkewed.Widened(24);
  EXPECT_DOUBLE_EQ(wider.inside_mm, 25);
  EXPECT_DOUBLE_EQ(wider.outside_mm * wider.outside_mm, 19 * 19 + 24 * 24);
  EXPECT_EQ(wider.freedom, kSkewed.freedom);
  EXPECT_EQ(wider.alike, kSkewed.alike);
  EXPECT_LT(wider.NatsAt(30), kSkewed.NatsAt(30));
  const ResidualNoise same = kSkewed.Widened(0);
  EXPECT_EQ(same.NatsAt(-30), kSkewed.NatsAt(-30));
}

// What all residuals together weigh grows with their number, but never beyond the independent ones.
TEST(ResidualNoise, OfManyResidualsCountsAsNoMoreThanTheIndependentOnes) {
  constexpr double kIndependent = 100;
  const auto together = [](int residuals) {
    return residuals / kSkewed.Of(residuals, kIndependent).alike;
  };
  EXPECT_NEAR(together(1), 1, 0.02);
  for (const int residuals : {1, 10, 100, 1000, 10'000}) {
    EXPECT_LT(together(residuals), together(2 * residuals));
    EXPECT_LT(together(residuals), kIndependent);
  }
  EXPECT_NEAR(together(1'000'000), kIndependent, 0.1);
}

TEST(LogSum, IsTheSumOfLogarithms) {
  LogSum sum;
  double wanted = 0;
  for (int i = 0; i < 3000; ++i) {
    const double scaled_square = std::pow(10, 4 * std::sin(1.7 * i));
    sum.Add(scaled_square);
    wanted += std::log1p(scaled_square);
  }
  EXPECT_NEAR(sum.Sum(), wanted, 1e-9 * wanted);
  EXPECT_EQ(LogSum().Sum(), 0);
}

TEST(LogSum, IsTheCostOfItsResiduals) {
  LogSum sum;
  double wanted = 0;
  for (double residual_mm = -150; residual_mm <= 150; residual_mm += 3) {
    sum.Add(kSkewed.ScaledSquare(residual_mm));
    wanted += kSkewed.NatsAt(residual_mm);
  }
  EXPECT_NEAR(kSkewed.NatsOf(sum.Sum()), wanted, 1e-9 * wanted);
}

}  // namespace
}  // namespace mocap
