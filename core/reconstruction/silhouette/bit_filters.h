// §4: silhouettes 64 pixels at a time.
#pragma once

#include <cstdint>
#include <span>

#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Sets pixels of one row where a bit of their byte is set. Pixels that are set stay so.
/// @param pixels  one byte a pixel.
/// @param bit     1, 2, 4 … 128.
/// @param begin   the first byte's pixel, a multiple of 8.
void PackRow(std::span<const std::uint8_t> pixels, unsigned bit, int begin, std::uint64_t* row);

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

/// Writes `from` over a part of `to`, whose other pixels stay.
/// @param left, top  where in `to` it begins; `left` is a multiple of 64, and `from` ends at such a
/// multiple or at the end of `to`.
void Paste(const Silhouette& from, int left, int top, Silhouette& to);

}  // namespace mocap
