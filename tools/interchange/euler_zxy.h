// Angles of rotations, in the order that BVH's channels and OpenSim's joints have.
#pragma once

#include "core/geometry.h"

namespace mocap {

/// Gives angles z, x, y of R = Rz Rx Ry [rad].
Vector3 AnglesZxy(const Matrix3& R);

/// Gives of all angles z, x, y that mean the same rotation those nearest to others, so that curves
/// have no jumps [rad].
Vector3 NearestEquivalent(const Vector3& angles, const Vector3& others);

}  // namespace mocap
