// Euler angles in the order of BVH's channels and OpenSim's joints.
#pragma once

#include "core/geometry.h"

namespace mocap {

/// Returns the angles z, x, y of R = Rz Rx Ry [rad].
Vector3 AnglesZxy(const Matrix3& R);

/// Returns the equivalent angles z, x, y that are nearest to others, so that curves have no jumps
/// [rad].
Vector3 NearestEquivalent(const Vector3& angles, const Vector3& others);

}  // namespace mocap
