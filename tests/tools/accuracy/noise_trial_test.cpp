#include "tools/accuracy/noise_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tools/accuracy/variety_trial.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;

constexpr ResidualNoise kDrawn{.freedom = 3, .inside_mm = 5, .outside_mm = 14};
constexpr int kAlike = 5;  // So many neighbours have the same error.

// Residuals of known noise: of 20 parts in 40 sets, in blocks that err alike.
NoiseTake Drawn(unsigned seed) {
  std::mt19937 random(seed);
  std::student_t_distribution<double> t(kDrawn.freedom);
  std::bernoulli_distribution is_inside(kDrawn.inside_mm / (kDrawn.inside_mm + kDrawn.outside_mm));
  NoiseTake take{
      .groups = {}, .odds = {}, .contacts = {}, .step_s = 0.1, .voxel_mm = 25, .sets = 40};
  for (int set = 0; set < take.sets; ++set) {
    for (int capsule = 0; capsule < 20; ++capsule) {
      ResidualGroup& group = take.groups.emplace_back();
      group.kind = NoiseKind::kRay;
      group.capsule = capsule;
      group.set = set;
      for (int block = 0; block < 8; ++block) {
        const double size = std::abs(t(random));
        const double error_mm =
            is_inside(random) ? -size * kDrawn.inside_mm : size * kDrawn.outside_mm;
        group.residuals_mm.insert(group.residuals_mm.end(), kAlike, static_cast<float>(error_mm));
      }
    }
  }
  return take;
}

TEST(FitNoise, FindsTheNoiseThatWasDrawn) {
  const std::vector<NoiseTake> takes = {Drawn(1), Drawn(2)};
  const MeasuredNoise measured = FitNoise(takes, NoiseKind::kRay);
  EXPECT_NEAR(measured.noise.freedom, kDrawn.freedom, 0.4);
  EXPECT_NEAR(measured.noise.inside_mm, kDrawn.inside_mm, 0.4);
  EXPECT_NEAR(measured.noise.outside_mm, kDrawn.outside_mm, 0.6);
  EXPECT_NEAR(measured.noise.alike, kAlike, 0.5);
  EXPECT_NEAR(measured.correlation, 0, 0.05);
  EXPECT_NEAR(measured.others_nats, measured.own_nats, 0.01);
  EXPECT_EQ(measured.residuals, 40 * 20 * 8 * kAlike);
  EXPECT_EQ(measured.far_share, 1);
}

// A twentieth of the bones is far from the flesh.
NoiseTake BonesDrawn() {
  NoiseTake take{
      .groups = {}, .odds = {}, .contacts = {}, .step_s = 0.1, .voxel_mm = 25, .sets = 1};
  for (int capsule = 0; capsule < 20; ++capsule) {
    ResidualGroup& group = take.groups.emplace_back();
    group.kind = NoiseKind::kFlesh;
    group.capsule = capsule;
    group.residuals_mm.resize(100, 0);
    for (int i = 0; i < 5; ++i) group.residuals_mm[i] = static_cast<float>(20 + 10 * i);
  }
  return take;
}

TEST(FitNoise, BonesInFleshMakeItUnlikelyToBeOutside) {
  const std::vector<NoiseTake> takes = {BonesDrawn(), BonesDrawn()};
  const MeasuredNoise measured = FitNoise(takes, NoiseKind::kFlesh);
  EXPECT_NEAR(measured.far_share, 0.05, 1e-12);
  EXPECT_EQ(measured.residuals, 2000);
  EXPECT_EQ(measured.noise.inside_mm, 0);
  EXPECT_LT(measured.noise.outside_mm, 12.5);
  EXPECT_EQ(measured.others_nats, measured.own_nats);
}

TEST(FitNoise, ErrorsThatStayAreCorrelated) {
  NoiseTake still = Drawn(1);
  for (ResidualGroup& group : still.groups)
    group.residuals_mm = still.groups[static_cast<std::size_t>(group.capsule)].residuals_mm;
  EXPECT_NEAR(FitNoise(std::vector{still, still}, NoiseKind::kRay).correlation, 1, 1e-9);
}

TEST(NoiseTrial, MeasuresWhereTheTrueJointsAre) {
  AccuracyTrial trial = VarietyTrialOf(1, 1.2, Filmings().front());
  trial.studio.varied = false;
  trial.studio.motion = "dance";
  trial.studio.width_px = 320;
  trial.studio.height_px = 240;
  const NoiseTake take = RunNoiseTrial(trial);
  EXPECT_GT(take.sets, 3);
  EXPECT_EQ(take.left_out, 0);
  EXPECT_NEAR(take.step_s, 0.1, 1e-12);
  const std::vector<NoiseTake> takes = {take, take};
  const MeasuredNoise rays = FitNoise(takes, NoiseKind::kRay);
  EXPECT_GT(rays.residuals, 1000);
  EXPECT_GT(rays.noise.outside_mm, 2);
  EXPECT_LT(rays.noise.outside_mm, 30);
  const MeasuredNoise flesh = FitNoise(takes, NoiseKind::kFlesh);
  EXPECT_LT(flesh.far_share, 0.2);
  EXPECT_GT(flesh.residuals, 100 * take.sets / 4);
  EXPECT_EQ(FitNoise(takes, NoiseKind::kBorder).noise.outside_mm, 0);
  EXPECT_FALSE(take.odds.empty());
  const std::string tables = NoiseTable(takes);
  EXPECT_THAT(tables, HasSubstr("\n| ray | "));
  EXPECT_THAT(tables, HasSubstr("\n| habits | "));
  EXPECT_EQ(NoiseTable(std::vector{take}), "");
}

}  // namespace
}  // namespace mocap
