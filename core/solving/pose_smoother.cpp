#include "core/solving/pose_smoother.h"

#include <Eigen/Cholesky>

namespace mocap {
namespace {

// Pose and velocity, and their joint covariance: at most twice kMaxDof.
using JointStep = Eigen::VectorXd;
using JointCovariance = Eigen::MatrixXd;

JointCovariance CovarianceOf(const MotionState& state) {
  const Eigen::Index n = state.pose.dof();
  JointCovariance covariance(2 * n, 2 * n);
  covariance << state.P, state.P_vx.transpose(), state.P_vx, state.P_vv;
  return covariance;
}

// Covariance of a state and the one that a time later follows from it: P Fᵀ.
JointCovariance WithNext(const MotionState& state, const MotionTransition& transition) {
  const Eigen::Index n = state.pose.dof();
  const JointCovariance P = CovarianceOf(state);
  JointCovariance product(2 * n, 2 * n);
  product.leftCols(n) = P.leftCols(n) + transition.reach_s * P.rightCols(n);
  product.rightCols(n) = transition.decay * P.rightCols(n);
  return product;
}

}  // namespace

std::vector<SmoothedPose> Smooth(std::span<const MotionState> filtered,
                                 std::span<const double> dt_s, const MotionNoise& noise) {
  std::vector<SmoothedPose> smoothed(filtered.size());
  if (filtered.empty()) return smoothed;
  smoothed.back() = {filtered.back().pose, filtered.back().P};
  const Eigen::Index n = filtered.back().pose.dof();
  PoseStep velocity = filtered.back().velocity;
  JointCovariance covariance = CovarianceOf(filtered.back());
  for (std::size_t k = filtered.size() - 1; k-- > 0;) {
    const MotionState& state = filtered[k];
    MotionState next = state;
    next.Propagate(noise, dt_s[k + 1]);
    const JointCovariance predicted = CovarianceOf(next);
    const JointCovariance with_next = WithNext(state, MotionTransition(noise, dt_s[k + 1]));
    const JointCovariance gain =
        Eigen::LLT<JointCovariance>(predicted).solve(with_next.transpose()).transpose();
    JointStep away(2 * n);
    away << smoothed[k + 1].pose.Minus(next.pose), velocity - next.velocity;
    const JointStep correction = gain * away;
    covariance = CovarianceOf(state) + gain * (covariance - predicted) * gain.transpose();
    smoothed[k] = {state.pose, covariance.topLeftCorner(n, n)};
    smoothed[k].pose.Add(correction.head(n));
    velocity = state.velocity + correction.tail(n);
  }
  return smoothed;
}

}  // namespace mocap
