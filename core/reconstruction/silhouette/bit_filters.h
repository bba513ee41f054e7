// §4: silhouettes 64 pixels at a time.
#pragma once

#include <cstdint>
#include <span>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Sets pixels of one row from one byte a pixel: 0 or 1. Pixels that are set stay so.
/// @param begin  the first byte's pixel, a multiple of 8.
void PackRow(std::span<const std::uint8_t> pixels, int begin, std::uint64_t* row);

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

}  // namespace mocap
