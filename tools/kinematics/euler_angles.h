// Euler angles in the orders of BVH's channels, OpenSim's joints and Plug-in Gait.
#pragma once

#include "core/geometry.h"

namespace mocap {

/// Returns the angles z, x, y of R = Rz Rx Ry [rad].
Vector3 AnglesZxy(const Matrix3& R);

/// Returns R = Rz Rx Ry of angles z, x, y [rad].
Matrix3 RotationZxy(const Vector3& zxy);

/// Returns the angles z, y, x of R = Rz Ry Rx [rad].
Vector3 AnglesZyx(const Matrix3& R);

/// Returns the angles x, z, y of R = Rx Rz Ry [rad].
Vector3 AnglesXzy(const Matrix3& R);

/// Returns the equivalent angles that are nearest to others, so that curves have no jumps [rad].
/// For any order of three different axes.
Vector3 NearestEquivalent(const Vector3& angles, const Vector3& others);

}  // namespace mocap
