// §6.1: the iterated extended Kalman filter over the pose.
//
// The error lives in the tangent space of the pose (PoseStep), so there are no redundant parameters
// and no gimbal lock. The update uses the information form: the cost of any number of points
// depends on the size of the state.
#pragma once

#include <functional>

#include "core/body/body_model.h"
#include "core/body/pose_state.h"
#include "core/body/update_equations.h"

namespace mocap {

/// Motion model, independent of the time between frames: white noise of acceleration drives
/// velocities that decay (Ornstein and Uhlenbeck 1930).
struct MotionNoise {
  double velocity_decay_s = 0.25;  ///< Without measurements a motion decays in this time.
  double translation_mm = 3000;    ///< [mm/s²/√Hz]
  double rotation_rad = 10;        ///< [rad/s²/√Hz]
  double joint_rad = 20;           ///< [rad/s²/√Hz]
};

/// A pose, its rate, and the joint covariance of their errors in the tangent space of the pose.
struct MotionState {
  PoseState pose;
  PoseStep velocity;    ///< [mm/s, rad/s]
  PoseCovariance P;     ///< Of the pose.
  PoseCovariance P_vx;  ///< Of velocity and pose.
  PoseCovariance P_vv;  ///< Of the velocity.

  /// Moves on by a time `dt_s`.
  void Propagate(const MotionNoise& noise, double dt_s);
};

/// How the state of a moment later depends on this one, but for noise: the pose on the velocity,
/// and the velocity on itself.
struct MotionTransition {
  MotionTransition(const MotionNoise& noise, double dt_s);

  double decay;    ///< Share of the velocity that is left.
  double reach_s;  ///< Time in which the velocity would lead as far if it stayed.
};

/// Number of linearisations: at most `usual` if the pose converges, and up to `most` while it still
/// moves far.
struct Iterations {
  int usual = 5;
  int most = 15;
};

/// Estimates pose and its rate from measurements. Allocates no memory.
class PoseFilter {
 public:
  explicit PoseFilter(const MotionNoise& noise) : noise_(noise) {}

  /// Starts at a pose with the given uncertainty.
  void Reset(const PoseState& pose, double translation_std_mm, double angle_std_rad);
  /// Likewise, with a standard deviation for each part of a PoseStep.
  void Reset(const PoseState& pose, const PoseStep& std);

  /// Predicts the pose after a time `dt_s`; the filter does not change.
  PoseState PredictedPose(double dt_s) const;
  /// Propagates pose and covariance by a time `dt_s`.
  void Predict(double dt_s) { state_.Propagate(noise_, dt_s); }

  /// Linearises the measurements at a pose; called once per iteration.
  using Linearize = std::function<void(const PoseState&, UpdateEquations&)>;

  /// Updates with measurements, which are linearised again in each iteration.
  void Update(const Linearize& linearize, const Iterations& iterations) {
    UpdateFrom(pose(), linearize, iterations);
  }
  /// The same, first linearised at a given pose: of several poses that explain the measurements,
  /// the one next to it is found.
  void UpdateFrom(const PoseState& start, const Linearize& linearize, const Iterations& iterations);

  /// Moves the pose as Update does, but keeps covariance and velocity.
  void Draw(const Linearize& linearize, const Iterations& iterations);

  /// Whether the last update produced a pose and a covariance. Otherwise the pose stayed the same,
  /// and the track is lost.
  bool is_sound() const { return is_sound_; }
  const PoseState& pose() const { return state_.pose; }
  const PoseCovariance& covariance() const { return state_.P; }
  const MotionState& state() const { return state_; }

  /// Moves the whole body, as if it had been predicted there.
  void Shift(const Vector3& by_W) { state_.pose.X_WT.p += by_W; }

  /// Jumps to a pose that was found by other means. Everything that was correlated with the old one
  /// becomes unknown.
  void Jump(const PoseState& pose);

 private:
  // Moves the pose from where it is to convergence, and returns the information about it there.
  PoseCovariance Iterate(const Linearize& linearize, const Iterations& iterations,
                         const PoseState& prior, const PoseCovariance& prior_information);
  void ForgetVelocity();

  MotionNoise noise_;
  bool is_sound_ = true;
  MotionState state_;
};

}  // namespace mocap
