// §4: how far one silhouette lies from another.
#pragma once

#include "core/geometry.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Where a silhouette lies against another one.
struct SilhouetteShift {
  Vector2 shift_px = Vector2::Zero();   ///< To the right and down: seen minus expected.
  double overlap = 0;                   ///< Intersection over union at that shift.
  Vector2 middle_px = Vector2::Zero();  ///< Of the box around what was seen and compared.
};

/// Finds the shift with the largest overlap, 14 px each way at most, to a fraction of a pixel.
/// Where one reaches its picture's edge, only what no such shift brings there is compared.
/// @pre  both are of one size.
SilhouetteShift MeasureShift(const Silhouette& silhouette, const Silhouette& expected);

/// Whether a silhouette reaches its picture's edge, so that a part of it may be missing, or is
/// empty.
bool TouchesBorder(const Silhouette& silhouette);

}  // namespace mocap
