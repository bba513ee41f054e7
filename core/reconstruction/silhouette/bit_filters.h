// §4: silhouettes 64 pixels at a time.
#pragma once

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Keeps the pixels whose whole square neighbourhood of 2 radius + 1 pixels is set; what lies
/// beyond the picture's edge counts as set.
/// @param radius  1 to 3.
void Erode(const Silhouette& from, int radius, Silhouette& to);

/// Sets every pixel that has one set within its square neighbourhood of 2 radius + 1 pixels.
/// @param radius  1 to 3.
void Dilate(const Silhouette& from, int radius, Silhouette& to);

/// Sets every pixel of `to` that is set in `from`.
void Unite(const Silhouette& from, Silhouette& to);

/// Empties every pixel of `to` that is empty in `from`.
void Intersect(const Silhouette& from, Silhouette& to);

/// Empties every pixel of `to` that is set in `from`.
void Subtract(const Silhouette& from, Silhouette& to);

/// Writes `from` over a part of `to`, whose other pixels stay.
/// @param left, top  where in `to` it begins; `left` is a multiple of 64, and `from` ends at such a
/// multiple or at the end of `to`.
void Paste(const Silhouette& from, int left, int top, Silhouette& to);

}  // namespace mocap
