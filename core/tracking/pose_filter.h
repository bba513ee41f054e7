// §6.1: the iterated extended Kalman filter over the pose.
//
// The error lives in the tangent of the pose (PoseStep), so that nothing is redundant and nothing
// locks; the update is done in information form, which takes any number of measured points at the
// cost of the state's size.
#pragma once

#include <array>
#include <functional>

#include "core/body/body_model.h"
#include "core/body/pose_state.h"

namespace mocap {

/// Sums up linearised measurements z - h(x) ≈ J δ as JᵀR⁻¹J and JᵀR⁻¹(z - h(x)).
class UpdateEquations {
 public:
  void Reset(int dof);
  /// Adds one scalar measurement.
  /// @param J         derivative of the prediction by a PoseStep.
  /// @param residual  measured less predicted.
  void Add(const PoseStep& J, double residual, double variance);
  /// Adds a measured point with the same variance [mm²] along all axes; J is 3 × dof.
  void AddPoint(const Eigen::Ref<const Eigen::Matrix<double, 3, Eigen::Dynamic>>& J,
                const Vector3& residual_mm, double variance_mm2);

  /// Adds to one product JᵢᵀR⁻¹Jⱼ with i <= j, and to one entry of JᵀR⁻¹(z - h(x)).
  void AddProduct(int i, int j, double sum) { columns_[j][i] += sum; }
  void AddGradient(int i, double sum) { gradient_[i] += sum; }

  /// The sums of all that was added; valid until more is.
  const PoseCovariance& information();
  const PoseStep& gradient() const { return gradient_; }

  /// Places in memory for a vector of any body, a multiple of the processor's vectors.
  static constexpr int kPlaces = (kMaxDof + 7) / 8 * 8;
  using Column = std::array<double, kPlaces>;

 private:
  int dof_ = 0;
  // The upper triangle; what lies below the diagonal means nothing.
  alignas(64) std::array<Column, kMaxDof> columns_;
  PoseCovariance information_;
  PoseStep gradient_;
};

/// How fast a body's pose may change: white noise of acceleration drives velocities that die out
/// (Ornstein and Uhlenbeck 1930), whatever the time between frames.
struct MotionNoise {
  double velocity_decay_s = 0.25;  ///< Without news a motion dies out in this time.
  double translation_mm = 3000;    ///< [mm/s²/√Hz]
  double rotation_rad = 10;        ///< [rad/s²/√Hz]
  double joint_rad = 20;           ///< [rad/s²/√Hz]
};

/// How often measurements are linearised: `usual` times at most where the pose comes to rest, and
/// up to `most` times while it still goes far.
struct Iterations {
  int usual = 5;
  int most = 15;
};

/// Estimates pose and its rate from measurements. Allocates nothing.
class PoseFilter {
 public:
  explicit PoseFilter(const MotionNoise& noise) : noise_(noise) {}

  /// Starts at a pose of which this much is known.
  void Reset(const PoseState& pose, double translation_std_mm, double angle_std_rad);

  /// Where the pose will be a time `dt_s` later; the filter stays as it is.
  PoseState PredictedPose(double dt_s) const;
  /// Takes pose and covariance to a time `dt_s` later.
  void Predict(double dt_s);

  /// Linearises the measurements at a pose; called once an iteration.
  using Linearize = std::function<void(const PoseState&, UpdateEquations&)>;

  /// Updates with measurements, linearised anew at each iteration. Joint limits hold as inequality
  /// constraints: an angle beyond its limit is measured to be at the limit, so that the rest of the
  /// chain takes up what it cannot.
  void Update(const BodyTable& table, const Linearize& linearize, const Iterations& iterations);

  /// Moves the pose as Update does, for whom it is all that counts: how well it is known, and how
  /// fast it changes, stay.
  void Draw(const BodyTable& table, const Linearize& linearize, const Iterations& iterations);

  /// Whether the last update came to a pose and a covariance; otherwise the pose stayed as it was,
  /// and the track is lost.
  bool is_sound() const { return is_sound_; }
  const PoseState& pose() const { return pose_; }
  const PoseCovariance& covariance() const { return P_; }

  /// Moves the whole body, as if it had been predicted there.
  void Shift(const Vector3& by_W) { pose_.X_WT.p += by_W; }

  /// Goes to a pose that was found by other means: what was correlated with the old one is unknown
  /// again.
  void Jump(const PoseState& pose);

 private:
  // Returns the information about the pose where it comes to rest.
  PoseCovariance Iterate(const BodyTable& table, const Linearize& linearize,
                         const Iterations& iterations, const PoseCovariance& prior_information);
  PoseStep NoiseDensity() const;
  PoseStep VelocityVariance() const;  // Of who is seen for the first time.
  void ForgetVelocity();

  MotionNoise noise_;
  bool is_sound_ = true;
  PoseState pose_;
  PoseStep velocity_;
  // Blocks of the joint covariance of pose error and velocity.
  PoseCovariance P_;
  PoseCovariance P_vx_;
  PoseCovariance P_vv_;
};

}  // namespace mocap
