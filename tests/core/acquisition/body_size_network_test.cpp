#include "core/acquisition/body_size_network.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocap {
namespace {

LengthMeasurements Thigh(double thigh_mm) {
  LengthMeasurements measured;
  measured.thigh = thigh_mm;
  return measured;
}

BodySizes Believed() { return AverageSizes(1750); }

TEST(BodySizeNetwork, WithoutEvidenceGivesThePriorOfTable3) {
  BodySizes sizes = Believed();
  BodySizeNetwork(BodyProportions{}).Update({}, false, sizes);
  EXPECT_NEAR(sizes.torso, 500, 1e-6);
  EXPECT_NEAR(sizes.thigh, 450, 1e-6);
  EXPECT_NEAR(sizes.calf, 500, 1e-6);
  EXPECT_NEAR(sizes.upper_arm, 275, 1e-6);
  EXPECT_NEAR(sizes.lower_arm, 375, 1e-6);
}

// One measured leaf, by hand: torso t ~ N(500, 300²), thigh h = 0.9 t + N(0, 100²), Thm = h + N(0,
// 200²).
TEST(BodySizeNetwork, WeighsOneMeasurementAsBayesSays) {
  BodySizes sizes = Believed();
  BodySizeNetwork(BodyProportions{}).Update(Thigh(600), false, sizes);
  const double variance_thigh = 0.81 * 300 * 300 + 100 * 100;
  const double gain = variance_thigh / (variance_thigh + 200 * 200);
  EXPECT_NEAR(sizes.thigh, 450 + gain * 150, 1e-6);
  const double covariance_torso = 0.9 * 300 * 300;
  EXPECT_NEAR(sizes.torso, 500 + covariance_torso / (variance_thigh + 200 * 200) * 150, 1e-6);
}

TEST(BodySizeNetwork, SettlesWhenTheSameIsMeasuredAgainAndAgain) {
  BodySizes sizes = Believed();
  const BodySizeNetwork network{BodyProportions{}};
  const LengthMeasurements measured{
      .thigh = 430, .calf = 500, .upper_arm = 280, .lower_arm = 450, .height = 1500};
  network.Update(measured, false, sizes);
  double change_mm = INFINITY;
  int frames = 1;
  for (; change_mm >= 3 && frames < 20; ++frames) change_mm = network.Update(measured, true, sizes);
  EXPECT_LE(frames, 10);
  EXPECT_NEAR(sizes.thigh + sizes.calf + sizes.torso, 1500, 60);
}

TEST(BodySizeNetwork, ReportsHowFarTheLengthsMoved) {
  BodySizes sizes = Believed();
  const BodySizes before = sizes;
  const double change_mm = BodySizeNetwork(BodyProportions{}).Update({}, false, sizes);
  EXPECT_NEAR(change_mm,
              std::abs(sizes.torso - before.torso) + std::abs(sizes.thigh - before.thigh) +
                  std::abs(sizes.calf - before.calf) +
                  std::abs(sizes.upper_arm - before.upper_arm) +
                  std::abs(sizes.lower_arm - before.lower_arm),
              1e-9);
}

}  // namespace
}  // namespace mocap
