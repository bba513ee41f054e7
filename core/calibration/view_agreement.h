// §4, beyond the paper: whether two cameras can see the same people, by the geometry of two views.
#pragma once

#include <optional>
#include <vector>

#include "core/calibration/seen_shape.h"

namespace mocap {

/// The rays along which a camera sees the rim of a shape.
struct SeenCone {
  Vector3 eye_W = Vector3::Zero();  ///< [mm]
  std::vector<Vector3> rays_W;      ///< Directions of any length; empty: nobody is seen.
  bool is_cut = false;              ///< As in SeenShape.
};

/// Converts a shape to rays through a lens.
/// @param X_CW  the pose to assume, in place of the shape's own.
SeenCone ConeOf(const SeenShape& shape, const Lens& lens, const RigidTransform& X_CW);

/// How the ranges of epipolar planes of two views lie.
struct ViewAgreement {
  /// Intersection over union, 0 to 1. If one view cuts the people off, the share of its range that
  /// lies within the other's.
  double overlap = 0;
  /// Share of the smaller range that lies within the larger one. It stays high if one camera sees
  /// somebody whom the other does not see.
  double contained = 0;
};

/// Compares the epipolar tangents of two views.
///
/// The planes through both cameras' centres that touch a person in one view touch him in the other.
/// They bound a range of angles about the baseline, which both views must therefore share (Hartley
/// and Zisserman, 2004, §13.3.3). It needs no place of the person and no unit of length.
///
/// @return  empty if the views cannot be compared: nobody is seen, both are cut off, or the cameras
/// look along their baseline.
std::optional<ViewAgreement> AgreementOf(const SeenCone& a, const SeenCone& b);

}  // namespace mocap
