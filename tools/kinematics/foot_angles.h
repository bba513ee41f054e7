// Angles of the foot against the shin.
#pragma once

#include <limits>

#include "core/geometry.h"

namespace mocap {

/// [rad]; NaN: the result does not show the foot.
struct FootAngles {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  /// About the slanting axes of Rajagopal's model (2016): toes up, and the sole inward.
  double ankle = kUnknown, subtalar = kUnknown;
  double toes = kUnknown;  ///< Up against the foot.
  /// Toes up, the sole inward, toes inward; the turns follow each other in the order toes up, toes
  /// inward, sole inward (about z, y and x), as in Plug-in Gait.
  Vector3 about_shin = Vector3::Constant(kUnknown);
};

/// Computes the angles of a right foot.
///
/// Two axes cannot give every rotation. Their angles leave the smallest rotation unexplained.
/// @param R_ShinFoot  the identity for a foot that stands flat below an upright shin; axes x
///                    forward, y up, z right. That of a left foot must be mirrored.
FootAngles FootAnglesOf(const Matrix3& R_ShinFoot);

}  // namespace mocap
