#include "core/reconstruction/camera/head_aim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocap {
namespace {

/// A camera at the origin that looks along x, with its axes beside the lens.
CameraCalibration CameraOnHead() {
  CameraCalibration camera;
  camera.X_CW.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  camera.X_CW.p.setZero();
  PanTiltHead head;
  head.pan_axis_W = Vector3(0.01, -0.02, 1).normalized();
  head.pan_point_W = {-40, 5, -50};
  head.tilt_axis_W = Vector3(0.01, -1, 0.015).normalized();
  head.tilt_point_W = {-30, 0, 4};
  head.pan_scale = 1.02;
  head.tilt_scale = 0.98;
  head.zero = {0.05, -0.1};
  camera.head = head;
  return camera;
}

TEST(AimAt, BringsAPointToTheMiddleOfTheLens) {
  const CameraCalibration camera = CameraOnHead();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> around(-1.2, 1.2), up(-0.6, 0.6), far(700, 6000);
  for (int i = 0; i < 200; ++i) {
    const double pan = around(random), tilt = up(random);
    const Vector3 p_WQ = far(random) * Vector3(std::cos(pan) * std::cos(tilt),
                                               std::sin(pan) * std::cos(tilt), std::sin(tilt));
    const Vector3 p_CQ = camera.PoseAt(AimAt(camera, p_WQ)) * p_WQ;
    EXPECT_GT(p_CQ.z(), 0);
    EXPECT_NEAR(std::hypot(p_CQ.x(), p_CQ.y()) / p_CQ.z(), 0, 1e-9) << p_WQ.transpose();
  }
}

TEST(AimAt, GoesOnFromWhereTheHeadPoints) {
  const CameraCalibration camera = CameraOnHead();
  const Vector3 behind_W(-2000, 300, 100);
  const PanTiltAngles half_way{2.5, 0};
  const PanTiltAngles angles = AimAt(camera, behind_W, half_way);
  EXPECT_NEAR(angles.pan_rad, 2.9, 0.2);
  EXPECT_GT((camera.PoseAt(angles) * behind_W).z(), 0);
}

TEST(AimAt, PointOnTheAxisLeavesTheHeadNearWhereItIs) {
  const CameraCalibration camera = CameraOnHead();
  const PanTiltHead& head = *camera.head;
  const PanTiltAngles angles = AimAt(camera, head.pan_point_W - 1500 * head.pan_axis_W);
  EXPECT_TRUE(std::isfinite(angles.pan_rad) && std::isfinite(angles.tilt_rad));
}

}  // namespace
}  // namespace mocap
