#include "core/geometry.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace mocap {

Matrix3 ExpRotation(const Vector3& rotation_vector) {
  const double angle_sq = rotation_vector.squaredNorm();
  const Matrix3 W = Hat(rotation_vector);
  // Below this the series is exact to the last bit, the quotients are not.
  if (angle_sq < 1e-8)
    return Matrix3::Identity() + (1 - angle_sq / 6) * W + (0.5 - angle_sq / 24) * W * W;
  const double angle = std::sqrt(angle_sq);
  return Matrix3::Identity() + std::sin(angle) / angle * W +
         (1 - std::cos(angle)) / angle_sq * W * W;
}

Vector3 LogRotation(const Matrix3& R) {
  // Uses the quaternion, whose four branches are accurate at every angle up to π.
  Eigen::Quaterniond q(R);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-12) return 2 * q.vec();
  return 2 * std::atan2(sine, q.w()) / sine * q.vec();
}

Matrix3 NearestRotation(const Matrix3& R) {
  if ((R * R.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-12) return R;
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::Quaterniond RotationBetween(const Vector3& from, const Vector3& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

RigidTransform RotationAbout(const Vector3& axis, const Vector3& point, double angle) {
  const Matrix3 R = ExpRotation(axis * angle);
  return {R, point - R * point};
}

}  // namespace mocap
