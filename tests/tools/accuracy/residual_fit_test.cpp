#include "tools/accuracy/residual_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace mocap {
namespace {

// Draws residuals of a two-piece t; those of one side if the other's scale is 0.
Residuals Draw(const ResidualNoise& noise, int count) {
  std::mt19937 random(1);
  std::student_t_distribution<double> t(noise.freedom);
  std::bernoulli_distribution is_inside(noise.inside_mm / (noise.inside_mm + noise.outside_mm));
  Residuals residuals;
  for (int i = 0; i < count; ++i) {
    const double size = std::abs(t(random));
    residuals.mm.push_back(
        static_cast<float>(is_inside(random) ? -size * noise.inside_mm : size * noise.outside_mm));
  }
  return residuals;
}

TEST(FitResiduals, FindsTheNoiseThatTheyWereDrawnFrom) {
  const ResidualNoise drawn{.freedom = 2.5, .inside_mm = 6, .outside_mm = 17};
  const ResidualNoise fitted = FitResiduals(Draw(drawn, 100000));
  EXPECT_NEAR(fitted.freedom, drawn.freedom, 0.08);
  EXPECT_NEAR(fitted.inside_mm, drawn.inside_mm, 0.15);
  EXPECT_NEAR(fitted.outside_mm, drawn.outside_mm, 0.3);
}

TEST(FitResiduals, ResidualsOfOneSideAreHalfOfAT) {
  const ResidualNoise drawn{.freedom = 4, .inside_mm = 11, .outside_mm = 0};
  Residuals residuals = Draw(drawn, 100000);
  const ResidualNoise inside = FitResiduals(residuals);
  EXPECT_NEAR(inside.freedom, drawn.freedom, 0.2);
  EXPECT_NEAR(inside.inside_mm, drawn.inside_mm, 0.15);
  EXPECT_EQ(inside.outside_mm, 0);
  for (float& r : residuals.mm) r = -r;
  const ResidualNoise outside = FitResiduals(residuals);
  EXPECT_EQ(outside.inside_mm, 0);
  EXPECT_NEAR(outside.outside_mm, inside.inside_mm, 1e-6);
}

TEST(FitResiduals, ThoseThatAreOnlyKnownToBeSmallCount) {
  const ResidualNoise drawn{.freedom = 2, .inside_mm = 0, .outside_mm = 8};
  Residuals residuals = Draw(drawn, 100000);
  residuals.least_mm = 12;
  residuals.small =
      static_cast<double>(std::erase_if(residuals.mm, [](float r) { return r < 12; }));
  const ResidualNoise fitted = FitResiduals(residuals);
  EXPECT_NEAR(fitted.freedom, drawn.freedom, 0.1);
  EXPECT_NEAR(fitted.outside_mm, drawn.outside_mm, 0.3);
  EXPECT_EQ(fitted.inside_mm, 0);
}

TEST(FitResiduals, NoOtherNoiseHasAGreaterLikelihood) {
  const Residuals residuals = Draw({.freedom = 3, .inside_mm = 8, .outside_mm = 20}, 5000);
  const ResidualNoise best = FitResiduals(residuals);
  for (const double factor : {0.95, 1.05}) {
    for (double ResidualNoise::*member :
         {&ResidualNoise::freedom, &ResidualNoise::inside_mm, &ResidualNoise::outside_mm}) {
      ResidualNoise other = best;
      other.*member *= factor;
      EXPECT_LT(MeanNats(residuals, best), MeanNats(residuals, other));
    }
  }
}

TEST(MeanNats, IsTheLogarithmOfADensity) {
  const ResidualNoise noise{.freedom = 5, .inside_mm = 4, .outside_mm = 9, .alike = 3};
  double sum = 0;
  for (float r = -499.95F; r < 500; r += 0.1F) sum += 0.1 * std::exp(-MeanNats({.mm = {r}}, noise));
  EXPECT_NEAR(sum, 1, 1e-3);
}

}  // namespace
}  // namespace mocap
