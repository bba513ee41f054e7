// §4: the shift between two silhouettes.
#pragma once

#include "core/geometry.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Position of a silhouette relative to another one.
struct SilhouetteShift {
  Vector2 shift_px = Vector2::Zero();   ///< To the right and down: seen minus expected.
  double overlap = 0;                   ///< Intersection over union at that shift.
  Vector2 middle_px = Vector2::Zero();  ///< Centre of the box around the compared part.
};

/// Finds the shift with the largest overlap, up to 14 px in each direction, to a fraction of a
/// pixel. If a silhouette reaches its picture's edge, only pixels that no such shift brings there
/// are compared.
/// @pre  both have the same size.
SilhouetteShift MeasureShift(const Silhouette& silhouette, const Silhouette& expected);

/// Whether a silhouette is empty, or reaches its picture's edge, so that a part may be missing.
bool TouchesBorder(const Silhouette& silhouette);

}  // namespace mocap
