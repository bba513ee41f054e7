#include "core/solving/pose_smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

namespace mocap {
namespace {

// A person without joints, who does not turn: the motion is linear, and least squares over all
// moments at once are the truth.
class Smoother : public ::testing::Test {
 protected:
  static PoseState At(double x_mm) {
    PoseState pose;
    pose.X_WT.p = Vector3(x_mm, 0, 0);
    return pose;
  }
  // Measures x.
  static PoseFilter::Linearize Measuring(double x_mm) {
    return [x_mm](const PoseState& pose, UpdateEquations& equations) {
      equations.Add(PoseStep::Unit(kTorsoDof, 0), x_mm - pose.X_WT.p.x(), kStd_mm * kStd_mm);
    };
  }

  std::vector<MotionState> Filter(const std::vector<double>& measured_mm) const {
    PoseFilter filter(noise_);
    filter.Reset(At(0), kStartStd_mm, 0.1);
    std::vector<MotionState> states;
    for (std::size_t i = 0; i < measured_mm.size(); ++i) {
      if (i > 0) filter.Predict(kDt_s);
      filter.Update(Measuring(measured_mm[i]), {});
      states.push_back(filter.state());
    }
    return states;
  }

  // The most likely positions, from the joint covariance of all of them before the measurements.
  Eigen::VectorXd Batch(const std::vector<double>& measured_mm) const {
    const int n = static_cast<int>(measured_mm.size());
    std::vector<Eigen::Matrix2d> covariance(n);  // Of position and velocity.
    MotionState state = Filter({0}).front();
    PoseFilter start(noise_);
    start.Reset(At(0), kStartStd_mm, 0.1);
    state = start.state();
    Eigen::MatrixXd joint(n, n);
    for (int i = 0; i < n; ++i) {
      if (i > 0) state.Propagate(noise_, kDt_s);
      covariance[i] << state.P(0, 0), state.P_vx(0, 0), state.P_vx(0, 0), state.P_vv(0, 0);
      for (int j = i; j < n; ++j) {
        const MotionTransition t(noise_, (j - i) * kDt_s);
        joint(i, j) = joint(j, i) = covariance[i](0, 0) + t.reach_s * covariance[i](0, 1);
      }
    }
    Eigen::MatrixXd measured = joint;
    measured.diagonal().array() += kStd_mm * kStd_mm;
    return joint * measured.llt().solve(Eigen::Map<const Eigen::VectorXd>(measured_mm.data(), n));
  }

  std::vector<double> RandomWalk(int count) {
    std::normal_distribution<double> step(0, 30);
    std::vector<double> x_mm(1);
    while (static_cast<int>(x_mm.size()) < count) x_mm.push_back(x_mm.back() + step(random_));
    return x_mm;
  }

  static constexpr double kStd_mm = 20, kStartStd_mm = 200, kDt_s = 0.05;
  const MotionNoise noise_{};
  std::mt19937 random_{3};
};

TEST_F(Smoother, IsLeastSquaresOverAllMoments) {
  const std::vector<double> measured_mm = RandomWalk(25);
  const std::vector<double> dt_s(measured_mm.size(), kDt_s);
  const std::vector<SmoothedPose> smoothed = Smooth(Filter(measured_mm), dt_s, noise_);
  const Eigen::VectorXd batch = Batch(measured_mm);
  for (std::size_t i = 0; i < smoothed.size(); ++i)
    EXPECT_NEAR(smoothed[i].pose.X_WT.p.x(), batch[static_cast<Eigen::Index>(i)], 1e-6) << i;
}

TEST_F(Smoother, IsNeverLessCertainThanTheFilter) {
  const std::vector<double> measured_mm = RandomWalk(25);
  const std::vector<MotionState> filtered = Filter(measured_mm);
  const std::vector<double> dt_s(measured_mm.size(), kDt_s);
  const std::vector<SmoothedPose> smoothed = Smooth(filtered, dt_s, noise_);
  for (std::size_t i = 0; i + 1 < smoothed.size(); ++i)
    EXPECT_LT(smoothed[i].covariance(0, 0), filtered[i].P(0, 0)) << i;
  EXPECT_DOUBLE_EQ(smoothed.back().covariance(0, 0), filtered.back().P(0, 0));
}

TEST_F(Smoother, LeavesOneMomentAndNoneAlone) {
  EXPECT_TRUE(Smooth({}, {}, noise_).empty());
  const std::vector<MotionState> one = Filter({70});
  const std::vector<double> dt_s = {kDt_s};
  EXPECT_DOUBLE_EQ(Smooth(one, dt_s, noise_).front().pose.X_WT.p.x(), one.front().pose.X_WT.p.x());
}

}  // namespace
}  // namespace mocap
