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

}  // namespace

void PoseFilter::Reset(const PoseState& pose, double translation_std_mm, double angle_std_rad) {
  PoseStep std = PoseStep::Constant(pose.dof(), angle_std_rad);
  std.head<3>().setConstant(translation_std_mm);
  Reset(pose, std);
}

void PoseFilter::Reset(const PoseState& pose, const PoseStep& std) {
  pose_ = pose;
  P_ = std.array().square().matrix().asDiagonal();
  ForgetVelocity();
}

void PoseFilter::Jump(const PoseState& pose) { Reset(pose, 30, 0.3); }

PoseStep PoseFilter::NoiseDensity() const {
  const int n = pose_.dof();
  PoseStep density(n);
  density.head<3>().setConstant(noise_.translation_mm * noise_.translation_mm);
  density.segment<3>(3).setConstant(noise_.rotation_rad * noise_.rotation_rad);
  density.tail(n - kTorsoDof).setConstant(noise_.joint_rad * noise_.joint_rad);
  return density;
}

PoseStep PoseFilter::VelocityVariance() const {
  return NoiseDensity() * (noise_.velocity_decay_s / 2);
}

void PoseFilter::ForgetVelocity() {
  const int n = pose_.dof();
  velocity_.setZero(n);
  P_vx_.setZero(n, n);
  P_vv_ = VelocityVariance().asDiagonal();
}

PoseState PoseFilter::PredictedPose(double dt_s) const {
  PoseState pose = pose_;
  pose.Add(velocity_ * (noise_.velocity_decay_s * (1 - std::exp(-dt_s / noise_.velocity_decay_s))));
  return pose;
}

void PoseFilter::Predict(double dt_s) {
  const double tau_s = noise_.velocity_decay_s;
  const double decay = std::exp(-dt_s / tau_s);
  const double reach_s = tau_s * (1 - decay);
  pose_.Add(velocity_ * reach_s);
  velocity_ *= decay;
  P_ += reach_s * (P_vx_ + P_vx_.transpose()) + reach_s * reach_s * P_vv_;
  P_vx_ = decay * (P_vx_ + reach_s * P_vv_);
  P_vv_ *= decay * decay;
  const PoseStep density = NoiseDensity();
  P_.diagonal() += density * (tau_s * tau_s * (dt_s - reach_s) - tau_s * reach_s * reach_s / 2);
  P_vx_.diagonal() += density * (reach_s * reach_s / 2);
  P_vv_.diagonal() += density * (tau_s * (1 - decay * decay) / 2);
}

PoseCovariance PoseFilter::Iterate(const Linearize& linearize, const Iterations& iterations,
                                   const PoseCovariance& prior_information) {
  const PoseState prior = pose_;
  UpdateEquations equations;
  PoseCovariance information;
  bool goes_far = false;
  for (int i = 0; i < (goes_far ? iterations.most : iterations.usual); ++i) {
    equations.Reset(pose_.dof());
    linearize(pose_, equations);
    information = prior_information + equations.information();
    const PoseStep gradient = equations.gradient() - prior_information * pose_.Minus(prior);
    const PoseStep step = Eigen::LLT<PoseCovariance>(information).solve(gradient);
    pose_.Add(step);
    const double step_mm = step.head<3>().norm(), step_rad = step.tail(step.size() - 3).norm();
    if (step_mm < kSteps.small_mm && step_rad < kSteps.small_rad) break;
    goes_far = step_mm > kSteps.far_mm || step_rad > kSteps.far_rad;
  }
  return information;
}

void PoseFilter::Draw(const Linearize& linearize, const Iterations& iterations) {
  const PoseState prior = pose_;
  const auto prior_information = InverseOfPositive(P_);
  if (prior_information) Iterate(linearize, iterations, *prior_information);
  is_sound_ = prior_information && pose_.IsFinite();
  if (!is_sound_) pose_ = prior;
}

void PoseFilter::Update(const Linearize& linearize, const Iterations& iterations) {
  const PoseState prior = pose_;
  const auto prior_information = InverseOfPositive(P_);
  const auto posterior = prior_information
                             ? InverseOfPositive(Iterate(linearize, iterations, *prior_information))
                             : std::nullopt;
  is_sound_ = posterior && pose_.IsFinite();
  if (!is_sound_) {
    pose_ = prior;
    return;
  }
  // The velocity was not measured. It follows the pose according to their correlation.
  const PoseCovariance gain = P_vx_ * *prior_information;
  velocity_ += gain * pose_.Minus(prior);
  P_vv_ -= gain * (P_ - *posterior) * gain.transpose();
  P_vv_ = PoseCovariance(0.5 * (P_vv_ + P_vv_.transpose()));
  P_vx_ = gain * *posterior;
  P_ = *posterior;
}

}  // namespace mocap
