#include "tools/accuracy/residual_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocap {
namespace {

constexpr ResidualNoise kNoise{.sigma_mm = 12, .outlier_share = 0.1, .reach_mm = 300};

TEST(ResidualNoise, IsADensity) {
  double sum = 0;
  for (double r = -149.5; r < 150; ++r) sum += std::exp(-kNoise.Nats(r));
  EXPECT_NEAR(sum, 1, 1e-6);
}

TEST(ResidualNoise, ASlopeIsThatOfANormalResidualTimesTheChanceOfOne) {
  constexpr double kStep_mm = 1e-4;
  for (const double r : {-140.0, -60.0, -20.0, -3.0, 1.0, 12.0, 45.0, 149.0}) {
    const double slope = (kNoise.Nats(r + kStep_mm) - kNoise.Nats(r - kStep_mm)) / (2 * kStep_mm);
    EXPECT_NEAR(kNoise.Inlier(r) * r / (12 * 12), slope, 1e-7) << r;
  }
}

TEST(ResidualNoise, WhatIsFarAwayIsAnOutlier) {
  EXPECT_GT(kNoise.Inlier(0), 0.98);
  EXPECT_LT(kNoise.Inlier(60), 0.01);
}

}  // namespace
}  // namespace mocap
