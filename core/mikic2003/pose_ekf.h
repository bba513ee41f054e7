// §6.1: the iterated extended Kalman filter over the paper's 23 numbers. Table 1, Eqs. (14)–(21).
#pragma once

#include <Eigen/Core>

#include "core/body/body_model.h"
#include "core/mikic2003/limbs.h"

namespace mocap::mikic2003 {

/// x = [t0 (3), ω0 (3), θ0, θ1 … θ16], Eq. (15); [mm, rad].
inline constexpr int kStateSize = 23;
using State = Eigen::Matrix<double, kStateSize, 1>;
using StateCovariance = Eigen::Matrix<double, kStateSize, kStateSize>;
using PointJacobian = Eigen::Matrix<double, 3, kStateSize>;

/// Returns the rotation matrix of an axis of any length and an angle. Eq. (9).
Matrix3 TorsoRotation(const Vector3& axis, double angle_rad);

/// Converts a pose to a state; the torso's axis points up rather than down.
State StateOf(const BodyModel& body, const PoseState& pose);
/// Converts a state to a pose.
PoseState PoseOf(const BodyModel& body, const State& x);

/// Differentiates a point by the state. Eqs. (17)–(21).
/// @param p_WQ  position of the point in this state.
PointJacobian DifferentiatePoint(const BodyModel& body, const State& x, const Posture& posture,
                                 Point point, const Vector3& p_WQ);

/// Tracks a body by measured points.
///
/// F is the identity. The paper does not give Q, R and P[0/0]. Here a coordinate changes between
/// frames as much as a fast person's does, and each measured point has an error of 50 mm, two
/// voxels of the paper's. An angle beyond its limit is set to the limit after each iteration.
///
/// ω0 is undefined if θ0 is 0. So the filter's frame V is the world turned about the vertical so
/// that θ0 is near π. It is turned again when the person has turned by 120 degrees.
class PoseEkf {
 public:
  /// Starts at a pose of large uncertainty.
  PoseEkf(const BodyModel& body, const PoseState& pose);

  /// Adds the process noise for a time step. Eq. (14).
  void Predict(double dt_s);

  /// Updates with a frame's measurements. The Jacobian is recomputed in each iteration.
  void Update(const BodyModel& body, const MeasuredPoints& points_W, int iterations);

  PoseState Pose(const BodyModel& body) const;
  /// Returns the covariance of a point of the body [mm²].
  Matrix3 PointCovariance(const BodyModel& body, Point point) const;

 private:
  void TurnFrame();

  Matrix3 R_WV_ = Matrix3::Identity();
  State x_;
  StateCovariance P_;
};

/// Returns the sum of distances between measured points and the body's points [mm]. §7.3.
double SumOfDistances(const BodyModel& body, const PoseState& pose, const MeasuredPoints& points_W);

}  // namespace mocap::mikic2003
