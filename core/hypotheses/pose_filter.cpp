#include "core/hypotheses/pose_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

namespace mocap {
namespace {

struct Steps {
  double small_mm = 0.5, small_rad = 0.003;  // Smaller ones are not worth another iteration.
  // If frames are far apart, poses have not converged after the usual iterations, and limbs that
  // have not been fitted completely seem lost.
  double far_mm = 10, far_rad = 0.1;
};
constexpr Steps kSteps{};

// Empty if rounding or a NaN measurement has made the matrix unusable.
std::optional<PoseCovariance> InverseOfPositive(const PoseCovariance& matrix) {
  const Eigen::LLT<PoseCovariance> cholesky(matrix);
  if (cholesky.info() != Eigen::Success || !matrix.allFinite()) return std::nullopt;
  const PoseCovariance inverse =
      cholesky.solve(PoseCovariance::Identity(matrix.rows(), matrix.cols()));
  return PoseCovariance(0.5 * (inverse + inverse.transpose()));
}

PoseStep NoiseDensity(const MotionNoise& noise, int dof) {
  PoseStep density(dof);
  density.head<3>().setConstant(noise.translation_mm * noise.translation_mm);
  density.segment<3>(3).setConstant(noise.rotation_rad * noise.rotation_rad);
  density.tail(dof - kTorsoDof).setConstant(noise.joint_rad * noise.joint_rad);
  return density;
}

}  // namespace

MotionTransition::MotionTransition(const MotionNoise& noise, double dt_s)
    : decay(std::exp(-dt_s / noise.velocity_decay_s)),
      reach_s(noise.velocity_decay_s * (1 - decay)) {}

void MotionState::Propagate(const MotionNoise& noise, double dt_s) {
  const double tau_s = noise.velocity_decay_s;
  const auto [decay, reach_s] = MotionTransition(noise, dt_s);
  pose.Add(velocity * reach_s);
  velocity *= decay;
  P += reach_s * (P_vx + P_vx.transpose()) + reach_s * reach_s * P_vv;
  P_vx = decay * (P_vx + reach_s * P_vv);
  P_vv *= decay * decay;
  const PoseStep density = NoiseDensity(noise, pose.dof());
  P.diagonal() += density * (tau_s * tau_s * (dt_s - reach_s) - tau_s * reach_s * reach_s / 2);
  P_vx.diagonal() += density * (reach_s * reach_s / 2);
  P_vv.diagonal() += density * (tau_s * (1 - decay * decay) / 2);
}

void PoseFilter::Reset(const PoseState& pose, double translation_std_mm, double angle_std_rad) {
  PoseStep std = PoseStep::Constant(pose.dof(), angle_std_rad);
  std.head<3>().setConstant(translation_std_mm);
  Reset(pose, std);
}

void PoseFilter::Reset(const PoseState& pose, const PoseStep& std) {
  state_.pose = pose;
  state_.P = std.array().square().matrix().asDiagonal();
  ForgetVelocity();
}

void PoseFilter::Jump(const PoseState& pose) { Reset(pose, 30, 0.3); }

// Somebody who is seen for the first time may have any velocity of the motion model.
void PoseFilter::ForgetVelocity() {
  const int n = state_.pose.dof();
  state_.velocity.setZero(n);
  state_.P_vx.setZero(n, n);
  const PoseStep variance = NoiseDensity(noise_, n) * (noise_.velocity_decay_s / 2);
  state_.P_vv = variance.asDiagonal();
}

PoseState PoseFilter::PredictedPose(double dt_s) const {
  PoseState pose = state_.pose;
  pose.Add(state_.velocity * MotionTransition(noise_, dt_s).reach_s);
  return pose;
}

PoseCovariance PoseFilter::Iterate(const Linearize& linearize, const Iterations& iterations,
                                   const PoseState& prior,
                                   const PoseCovariance& prior_information) {
  PoseState& pose = state_.pose;
  UpdateEquations equations;
  PoseCovariance information;
  bool goes_far = false;
  for (int i = 0; i < (goes_far ? iterations.most : iterations.usual); ++i) {
    equations.Reset(pose.dof());
    linearize(pose, equations);
    information = prior_information + equations.information();
    const PoseStep gradient = equations.gradient() - prior_information * pose.Minus(prior);
    const PoseStep step = Eigen::LLT<PoseCovariance>(information).solve(gradient);
    pose.Add(step);
    const double step_mm = step.head<3>().norm(), step_rad = step.tail(step.size() - 3).norm();
    if (step_mm < kSteps.small_mm && step_rad < kSteps.small_rad) break;
    goes_far = step_mm > kSteps.far_mm || step_rad > kSteps.far_rad;
  }
  return information;
}

void PoseFilter::Draw(const Linearize& linearize, const Iterations& iterations) {
  const PoseState prior = pose();
  const auto prior_information = InverseOfPositive(state_.P);
  if (prior_information) Iterate(linearize, iterations, prior, *prior_information);
  is_sound_ = prior_information && pose().IsFinite();
  if (!is_sound_) state_.pose = prior;
}

void PoseFilter::UpdateFrom(const PoseState& start, const Linearize& linearize,
                            const Iterations& iterations) {
  const PoseState prior = pose();
  const auto prior_information = InverseOfPositive(state_.P);
  state_.pose = start;
  const auto posterior =
      prior_information
          ? InverseOfPositive(Iterate(linearize, iterations, prior, *prior_information))
          : std::nullopt;
  is_sound_ = posterior && pose().IsFinite();
  if (!is_sound_) {
    state_.pose = prior;
    return;
  }
  // The velocity was not measured. It follows the pose according to their correlation.
  const PoseCovariance gain = state_.P_vx * *prior_information;
  state_.velocity += gain * pose().Minus(prior);
  state_.P_vv -= gain * (state_.P - *posterior) * gain.transpose();
  state_.P_vv = PoseCovariance(0.5 * (state_.P_vv + state_.P_vv.transpose()));
  state_.P_vx = gain * *posterior;
  state_.P = *posterior;
}

}  // namespace mocap
