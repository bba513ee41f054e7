// Rotations and rigid transforms in monogram notation: X_CW transforms points from the world W to
// the camera C, p_WQ is point Q in W. Adjacent letters match in products. Units are millimetres and
// radians.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace mocap {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Returns the matrix of the cross product: Hat(w) v = w × v. Mikić et al. 2003, Eq. (3).
inline Matrix3 Hat(const Vector3& w) {
  Matrix3 m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

/// Converts a rotation vector (axis times angle [rad]) to a rotation matrix. Mikić et al. 2003, Eq.
/// (7).
Matrix3 ExpRotation(const Vector3& rotation_vector);

/// Converts a rotation matrix to its rotation vector [rad] of length at most π; the inverse of
/// ExpRotation.
Vector3 LogRotation(const Matrix3& R);

/// Returns the rotation nearest to a matrix that is almost one; a rotation stays unchanged.
/// @param R  with a positive determinant.
Matrix3 NearestRotation(const Matrix3& R);

/// Returns the shortest rotation from one direction to another. Compiling Eigen's costs seconds, so
/// that is done in one place.
Eigen::Quaterniond RotationBetween(const Vector3& from, const Vector3& to);

/// Transforms points from one frame to another: p_A = R_AB p_B + p_AB.
struct RigidTransform {
  Matrix3 R = Matrix3::Identity();
  Vector3 p = Vector3::Zero();

  Vector3 operator*(const Vector3& point) const { return R * point + p; }
  RigidTransform operator*(const RigidTransform& other) const {
    return {R * other.R, R * other.p + p};
  }
  RigidTransform Inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Rotates about an axis that need not pass through the origin.
///
/// @param axis   unit vector.
/// @param point  any point on the axis [mm].
/// @return  the transform that rotates a body by `angle` [rad], right-handed. Mikić et al. 2003,
/// Eq. (6).
RigidTransform RotationAbout(const Vector3& axis, const Vector3& point, double angle);

}  // namespace mocap
