#include "core/reconstruction/camera/head_aim.h"

#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kSteps = 12;
constexpr double kDifference_rad = 1e-5;
// Far from the centre the tangent overshoots.
constexpr double kLongestStep_rad = 0.4;
// Relative to the square of a derivative near 1. Keeps steps short where an axis has no effect.
constexpr double kDamping = 1e-6;

/// Angles to the right and down at which the camera sees a point [rad].
Vector2 OffCenter(const CameraCalibration& camera, const PanTiltAngles& angles,
                  const Vector3& p_WQ) {
  const Vector3 p_CQ = camera.PoseAt(angles) * p_WQ;
  return {std::atan2(p_CQ.x(), p_CQ.z()), std::atan2(p_CQ.y(), std::hypot(p_CQ.x(), p_CQ.z()))};
}

}  // namespace

PanTiltAngles AimAt(const CameraCalibration& camera, const Vector3& p_WQ,
                    const PanTiltAngles& from) {
  MOCAP_CHECK(camera.head.has_value());
  PanTiltAngles angles = from;
  for (int i = 0; i < kSteps; ++i) {
    const auto [pan, tilt] = angles;
    const Vector2 error = OffCenter(camera, angles, p_WQ);
    Eigen::Matrix2d J;
    J.col(0) = (OffCenter(camera, {pan + kDifference_rad, tilt}, p_WQ) - error) / kDifference_rad;
    J.col(1) = (OffCenter(camera, {pan, tilt + kDifference_rad}, p_WQ) - error) / kDifference_rad;
    const Eigen::Matrix2d damped = J.transpose() * J + kDamping * Eigen::Matrix2d::Identity();
    Vector2 step = damped.inverse() * (J.transpose() * error);
    step = step.cwiseMax(-kLongestStep_rad).cwiseMin(kLongestStep_rad);
    angles = {pan - step.x(), tilt - step.y()};
  }
  return angles;
}

}  // namespace mocap
