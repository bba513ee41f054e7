#include "core/evaluation/precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mocap {
namespace {

constexpr SmoothingOptions kPaper;

TEST(SavitzkyGolay, WeighsTheMiddleOfAWindowAsThePublishedTable) {
  // Savitzky and Golay 1964, Table I: quadratic and cubic smoothing over 15 points.
  const double weights[] = {-78, -13, 42, 87, 122, 147, 162, 167, 162, 147, 122, 87, 42, -13, -78};
  for (int i = 0; i < 15; ++i) {
    Eigen::VectorXd impulse = Eigen::VectorXd::Zero(15);
    impulse[i] = 1;
    EXPECT_NEAR(SmoothSavitzkyGolay(impulse, kPaper)[7], weights[i] / 1105, 1e-12);
  }
}

TEST(SavitzkyGolay, WeighsFivePointsAsThePublishedTable) {
  const double weights[] = {-3, 12, 17, 12, -3};
  for (int i = 0; i < 5; ++i) {
    Eigen::VectorXd impulse = Eigen::VectorXd::Zero(5);
    impulse[i] = 1;
    EXPECT_NEAR(SmoothSavitzkyGolay(impulse, {2, 2})[2], weights[i] / 35, 1e-12);
  }
}

TEST(SavitzkyGolay, KeepsACubicUnchangedUpToBothEnds) {
  Eigen::VectorXd cubic(40);
  for (int i = 0; i < 40; ++i) cubic[i] = 2 - 3 * i + 0.5 * i * i - 0.02 * i * i * i;
  EXPECT_NEAR((SmoothSavitzkyGolay(cubic, kPaper) - cubic).cwiseAbs().maxCoeff(), 0, 1e-10);
}

TEST(SavitzkyGolay, DoesNotKeepAQuartic) {
  Eigen::VectorXd quartic(40);
  for (int i = 0; i < 40; ++i) quartic[i] = std::pow(i / 10.0, 4);
  EXPECT_GT((SmoothSavitzkyGolay(quartic, kPaper) - quartic).cwiseAbs().minCoeff(), 1e-3);
}

TEST(SavitzkyGolay, TakesAShortSeriesAsOneWindow) {
  EXPECT_EQ(SmoothSavitzkyGolay(Eigen::VectorXd(), kPaper).size(), 0);
  const Eigen::VectorXd three = Eigen::Vector3d(4, -1, 7);
  EXPECT_NEAR((SmoothSavitzkyGolay(three, kPaper) - three).norm(), 0, 1e-12);
  const Eigen::VectorXd mean = SmoothSavitzkyGolay(three, {0, 7});
  EXPECT_NEAR((mean.array() - 10.0 / 3).matrix().norm(), 0, 1e-12);
}

TEST(UnwrapAngles, RemovesWholeTurnsOnly) {
  Eigen::VectorXd slope(30), wrapped(30);
  for (int i = 0; i < 30; ++i) {
    slope[i] = 0.5 * i;
    wrapped[i] = std::remainder(slope[i], 2 * std::numbers::pi);
  }
  EXPECT_NEAR((UnwrapAngles(wrapped) - slope).norm(), 0, 1e-12);
}

/// Cubic paths everywhere, which the smoother keeps, with an alternating error on θ3 and one point.
std::vector<PoseSample> RunWithAlternatingError(int frames, double angle_rad, double point_mm) {
  std::vector<PoseSample> run(frames);
  for (int i = 0; i < frames; ++i) {
    const double sign = i % 2 ? -1 : 1;
    for (double& theta : run[i].paper.theta_rad) theta = 0.01 * i;
    run[i].paper.theta_rad[2] += sign * angle_rad;
    run[i].points_W.setConstant(3.0 * i * i);
    run[i].points_W.col(5) += sign * point_mm * Vector3(0, 0.6, 0.8);
  }
  return run;
}

TEST(Precision, IsTheMeanDistanceFromTheSmoothedCurve) {
  const std::vector<std::vector<PoseSample>> runs = {RunWithAlternatingError(200, 0.1, 20)};
  const auto precision = MeasurePrecision(runs, kPaper);
  ASSERT_TRUE(precision);
  // Away from the ends an alternating error is damped to
  // (167 - 2·162 + 2·147 - 2·122 + 2·87 - 2·42 - 2·13 + 2·78) / 1105 of itself.
  const double left_after_smoothing =
      (167.0 - 2 * 162 + 2 * 147 - 2 * 122 + 2 * 87 - 2 * 42 - 2 * 13 + 2 * 78) / 1105;
  EXPECT_NEAR(precision->angle_rad[2], 0.1 * (1 - left_after_smoothing), 0.003);
  EXPECT_NEAR(precision->point_mm[5], 20 * (1 - left_after_smoothing), 0.6);
  EXPECT_NEAR(precision->mean_angle_rad, precision->angle_rad[2] / 16, 1e-12);
  EXPECT_NEAR(precision->mean_angle_without_twist_rad, precision->angle_rad[2] / 14, 1e-12);
  EXPECT_NEAR(precision->mean_point_mm, precision->point_mm[5] / 23, 1e-9);
  EXPECT_EQ(precision->frames, 200);
}

TEST(Precision, IgnoresAnAnglesJumpByATurn) {
  std::vector<PoseSample> run = RunWithAlternatingError(60, 0, 0);
  for (int i = 30; i < 60; ++i) run[i].paper.theta_rad[7] -= 2 * std::numbers::pi;
  EXPECT_NEAR(MeasurePrecision({{run}}, kPaper)->angle_rad[7], 0, 1e-12);
}

TEST(Precision, LeavesOutRunsShorterThanTheWindow) {
  const std::vector<std::vector<PoseSample>> runs = {RunWithAlternatingError(14, 1, 0),
                                                     RunWithAlternatingError(15, 0, 0)};
  const auto precision = MeasurePrecision(runs, kPaper);
  ASSERT_TRUE(precision);
  EXPECT_EQ(precision->frames, 15);
  EXPECT_NEAR(precision->angle_rad[2], 0, 1e-12);
  EXPECT_FALSE(MeasurePrecision({{RunWithAlternatingError(14, 1, 0)}}, kPaper));
}

}  // namespace
}  // namespace mocap
