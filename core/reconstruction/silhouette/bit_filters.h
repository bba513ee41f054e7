// §4: operations on silhouettes, 64 pixels at a time.
#pragma once

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Keeps pixels whose whole square neighbourhood of 2 radius + 1 pixels is set. Pixels beyond the
/// picture's edge count as set.
/// @param radius  1 to 3.
void Erode(const Silhouette& from, int radius, Silhouette& to);

/// Sets every pixel with a set pixel in its square neighbourhood of 2 radius + 1 pixels.
/// @param radius  1 to 3.
void Dilate(const Silhouette& from, int radius, Silhouette& to);

/// Sets every pixel of `to` that is set in `from`.
void Unite(const Silhouette& from, Silhouette& to);

/// Clears every pixel of `to` that is not set in `from`.
void Intersect(const Silhouette& from, Silhouette& to);

/// Copies a silhouette, shifted by whole pixels to the right and down. What comes in is clear.
void Shift(const Silhouette& from, int right_px, int down_px, Silhouette& to);

/// Clears every pixel of `to` that is set in `from`.
void Subtract(const Silhouette& from, Silhouette& to);

}  // namespace mocap
