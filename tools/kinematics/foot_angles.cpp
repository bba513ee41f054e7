#include "tools/kinematics/foot_angles.h"

#include "tools/kinematics/euler_angles.h"

namespace mocap {
namespace {

/// Of the right foot, in the model's axes: ankle_angle and subtalar_angle.
Vector3 AnkleAxis() { return {-0.10501355, -0.17402245, 0.97912632}; }
Vector3 SubtalarAxis() { return {0.78717961, 0.60474746, -0.12094949}; }

}  // namespace

FootAngles FootAnglesOf(const Matrix3& R_ShinFoot) {
  // Gauss-Newton. It converges from 0, as the axes are far from parallel.
  constexpr int kSteps = 12;
  constexpr double kSmallStep_rad = 1e-9;
  Vector2 angles = Vector2::Zero();
  for (int i = 0; i < kSteps; ++i) {
    const Matrix3 R_subtalar = ExpRotation(SubtalarAxis() * angles[1]);
    const Matrix3 R = ExpRotation(AnkleAxis() * angles[0]) * R_subtalar;
    const Vector3 rest = LogRotation(R.transpose() * R_ShinFoot);
    Eigen::Matrix<double, 3, 2> J_by_angle;
    J_by_angle << R_subtalar.transpose() * AnkleAxis(), SubtalarAxis();
    const Vector2 step =
        (J_by_angle.transpose() * J_by_angle).inverse() * (J_by_angle.transpose() * rest);
    angles += step;
    if (step.norm() < kSmallStep_rad) break;
  }
  const Vector3 zyx = AnglesZyx(R_ShinFoot);
  return {.ankle = angles[0], .subtalar = angles[1], .about_shin = {zyx[0], zyx[2], zyx[1]}};
}

}  // namespace mocap
