#include "tools/kinematics/euler_zxy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mocap {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

Vector3 AnglesZxy(const Matrix3& R) {
  const double x = std::asin(std::clamp(R(2, 1), -1.0, 1.0));
  // At gimbal lock only the sum or difference of z and y counts.
  if (std::abs(R(2, 1)) > 1 - 1e-12) return {std::atan2(R(1, 0), R(0, 0)), x, 0};
  return {std::atan2(-R(0, 1), R(1, 1)), x, std::atan2(-R(2, 0), R(2, 2))};
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
