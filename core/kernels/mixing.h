// Interpolation between pixels, along rows.
#pragma once

#include <array>
#include <cstdint>

namespace mocap::kernels {

/// Interpolates between pixels and their right and lower neighbours.
/// @param a, b  shares of the neighbours to the right and below.
void MixNeighbours(const float* top, const float* bottom, int count, float a, float b, float* to);
/// Does so with integer weights: of the pixel, its right, its lower and its diagonal neighbour.
/// They sum to 256.
void MixByteNeighbours(const std::uint8_t* top, const std::uint8_t* bottom, int count,
                       const std::array<int, 4>& weights, std::uint8_t* to);

/// Interpolates between two rows.
/// @param b  share of the lower one.
void MixRows(const float* top, const float* bottom, int count, float b, float* to);

/// Interpolates between corners of cells.
/// @param width  places for each cell, 4 or 8.
/// @param into   share of the way from a corner to the next where a cell's first place lies.
void SpreadCells(const float* corners, int count, int width, float into, float* to);

/// A pixel of a picture: blue in the lowest byte, then green, red and the slope.
using PackedPixel = std::uint32_t;

/// Reads a picture between its pixels, whose places are x and y.
/// @param stride  pixels from one row to the next.
/// @param slope   gets that of the nearest pixel.
void ReadBetween(const PackedPixel* pixels, int stride, const float* x, const float* y, int count,
                 const std::array<float*, 3>& color, std::uint8_t* slope);
/// Reads the nearest pixels of a picture at half the resolution. The places are those in the full
/// picture.
void ReadNearestHalf(const PackedPixel* pixels, int stride, const float* x, const float* y,
                     int count, const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope);

}  // namespace mocap::kernels
