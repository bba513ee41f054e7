#include "tools/accuracy/noise_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tools/accuracy/variety_trial.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr double kSigma_mm = 9, kOutliers = 0.2;
constexpr int kAlike = 5;  // So many neighbours have the same error.

// Residuals of known noise: of 20 parts in 40 sets, in blocks that err alike.
NoiseTake Drawn(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, kSigma_mm);
  std::uniform_real_distribution<double> share(0, 1), anywhere(-150, 150);
  NoiseTake take{.groups = {}, .step_s = 0.1, .sets = 40};
  for (int set = 0; set < take.sets; ++set) {
    for (int capsule = 0; capsule < 20; ++capsule) {
      ResidualGroup& group = take.groups.emplace_back();
      group.kind = ResidualKind::kRay;
      group.capsule = capsule;
      group.set = set;
      for (int block = 0; block < 8; ++block) {
        const double error_mm = normal(random);
        for (int i = 0; i < kAlike; ++i) {
          group.residuals_mm.push_back(
              static_cast<float>(share(random) < kOutliers ? anywhere(random) : error_mm));
        }
      }
    }
  }
  return take;
}

TEST(FitNoise, FindsTheNoiseThatWasDrawn) {
  const std::vector<NoiseTake> takes = {Drawn(1), Drawn(2)};
  const MeasuredNoise measured = FitNoise(takes, ResidualKind::kRay);
  EXPECT_NEAR(measured.noise.sigma_mm, kSigma_mm, 0.3);
  EXPECT_NEAR(measured.noise.outlier_share, kOutliers, 0.01);
  EXPECT_NEAR(measured.noise.independent_share, 1.0 / kAlike, 0.05);
  EXPECT_NEAR(measured.correlation, 0, 0.05);
  EXPECT_NEAR(measured.others_nats, measured.own_nats, 0.01);
  EXPECT_EQ(measured.residuals, 40 * 20 * 8 * kAlike);
}

TEST(FitNoise, ErrorsThatStayAreCorrelated) {
  NoiseTake still = Drawn(1);
  for (ResidualGroup& group : still.groups)
    group.residuals_mm = still.groups[static_cast<std::size_t>(group.capsule)].residuals_mm;
  EXPECT_NEAR(FitNoise(std::vector{still, still}, ResidualKind::kRay).correlation, 1, 1e-9);
}

TEST(NoiseTrial, MeasuresWhereTheTrueJointsAre) {
  AccuracyTrial trial = VarietyTrialOf(1, 0.6, Filmings().front());
  trial.studio.varied = false;
  trial.studio.motion = "walk";
  trial.studio.width_px = 320;
  trial.studio.height_px = 240;
  const NoiseTake take = RunNoiseTrial(trial);
  EXPECT_GT(take.sets, 3);
  EXPECT_EQ(take.left_out, 0);
  EXPECT_NEAR(take.step_s, 0.1, 1e-12);
  const MeasuredNoise rays = FitNoise(std::vector{take, take}, ResidualKind::kRay);
  EXPECT_GT(rays.residuals, 1000);
  EXPECT_GT(rays.noise.sigma_mm, 4);
  EXPECT_LT(rays.noise.sigma_mm, 30);
  EXPECT_THAT(NoiseTable(std::vector{take, take}), HasSubstr("\n| ray | "));
  EXPECT_EQ(NoiseTable(std::vector{take}), "");
}

}  // namespace
}  // namespace mocap
