#include "tools/kinematics/euler_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap {
namespace {

constexpr double kPi = std::numbers::pi;

/// At gimbal lock only the sum or difference of the outer angles counts.
bool IsLocked(double sine) { return std::abs(sine) > 1 - 1e-12; }

}  // namespace

Vector3 AnglesZxy(const Matrix3& R) {
  const double x = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
  if (IsLocked(R(2, 1))) return {std::atan2(R(1, 0), R(0, 0)), x, 0};
  return {std::atan2(-R(0, 1), R(1, 1)), x, std::atan2(-R(2, 0), R(2, 2))};
}

Matrix3 RotationZxy(const Vector3& zxy) {
  return (Eigen::AngleAxisd(zxy[0], Vector3::UnitZ()) *
          Eigen::AngleAxisd(zxy[1], Vector3::UnitX()) * Eigen::AngleAxisd(zxy[2], Vector3::UnitY()))
      .toRotationMatrix();
}

Vector3 AnglesZyx(const Matrix3& R) {
  const double y = -std::asin(std::clamp(R(2, 0), -1.0, 1.0));
  if (IsLocked(R(2, 0))) return {std::atan2(-R(0, 1), R(1, 1)), y, 0};
  return {std::atan2(R(1, 0), R(0, 0)), y, std::atan2(R(2, 1), R(2, 2))};
}

Vector3 AnglesXzy(const Matrix3& R) {
  const double z = std::asin(std::clamp(-R(0, 1), -1.0, 1.0));
  if (IsLocked(R(0, 1))) return {std::atan2(-R(1, 2), R(2, 2)), z, 0};
  return {std::atan2(R(2, 1), R(1, 1)), z, std::atan2(R(0, 2), R(0, 0))};
}

Vector3 NearestEquivalent(const Vector3& angles, const Vector3& others) {
  const auto near_others = [&](const Vector3& a) {
    Vector3 moved;
    for (int i = 0; i < 3; ++i) moved[i] = others[i] + std::remainder(a[i] - others[i], 2 * kPi);
    return moved;
  };
  const Vector3 first = near_others(angles);
  const Vector3 second = near_others({angles[0] + kPi, kPi - angles[1], angles[2] + kPi});
  return (first - others).squaredNorm() <= (second - others).squaredNorm() ? first : second;
}

}  // namespace mocap
