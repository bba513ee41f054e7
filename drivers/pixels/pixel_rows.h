// Conversion of cameras' rows, compiled for each kind of processor as the kernels of core are. The
// formats of V4L2 and GenICam differ in layout only, so plain loops suffice, and no scaler.
#pragma once

#include <cstdint>

#include "core/image.h"

namespace mocap {

/// Converts luma and chroma, one byte per pixel each, to colours. Arrays do not overlap.
/// @param bgr  three bytes per pixel.
void ToBgr(const std::uint8_t* y, const std::uint8_t* u, const std::uint8_t* v, int width,
           std::uint8_t* bgr);

/// Splits pairs of pixels of four bytes: Y, U, Y, V.
void UnpackYuyv(const std::uint8_t* in, int pairs, std::uint8_t* y, std::uint8_t* u,
                std::uint8_t* v);
/// Splits pairs of pixels of four bytes: U, Y, V, Y.
void UnpackUyvy(const std::uint8_t* in, int pairs, std::uint8_t* y, std::uint8_t* u,
                std::uint8_t* v);
/// Splits chroma of pairs of pixels: U, V.
void UnpackPairs(const std::uint8_t* in, int pairs, std::uint8_t* u, std::uint8_t* v);

/// Three rows of a mosaic, around the row to fill.
struct MosaicRows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;

  /// Interpolates a pixel between its neighbours.
  /// @param is_own  whether it has the row's own colour, red or blue; otherwise it is green.
  Bgr PixelAt(int left, int x, int right, bool is_red_row, bool is_own) const {
    const int own = is_own ? here[x] : MeanOf(here[left], here[right]);
    const int green = is_own ? MeanOf(here[left], here[right], above[x], below[x]) : here[x];
    const int other = is_own ? MeanOf(above[left], above[right], below[left], below[right])
                             : MeanOf(above[x], below[x]);
    const auto byte = [](int value) { return static_cast<std::uint8_t>(value); };
    return {byte(is_red_row ? other : own), byte(green), byte(is_red_row ? own : other)};
  }

 private:
  static int MeanOf(int a, int b) { return (a + b + 1) / 2; }
  static int MeanOf(int a, int b, int c, int d) { return (a + b + c + d + 2) / 4; }
};

/// Interpolates the pixels of a row from `begin` on, a pixel of the row's own colour, but for the
/// last one or two.
void FillMosaicRow(const MosaicRows& rows, bool is_red_row, int begin, int width, Bgr* out);

}  // namespace mocap
