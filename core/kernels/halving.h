// §4: pictures at half the resolution, and means of their tiles. Of each four rows, the first two
// are read: that halves the time for memory, and nothing that is three pixels high lies between.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mocap::kernels {

/// Width of a tile, in pixels of the half picture, and its rows there.
inline constexpr int kTileSide = 4;
inline constexpr int kTileRows = 2;
inline constexpr int kTilePixels = kTileSide * kTileRows;
/// Rows of the picture from one row of the half picture to the next.
inline constexpr int kRowStep_px = 4;

/// Averages a byte of two adjacent pixels and of the two below.
inline std::uint8_t MeanOfFour(const std::uint8_t* top, const std::uint8_t* bottom) {
  return static_cast<std::uint8_t>((top[0] + top[3] + bottom[0] + bottom[3] + 2) >> 2);
}

/// Destination of adjacent halved tiles, per channel.
struct HalvedTiles {
  std::array<std::uint8_t*, 3> color;
  std::array<float*, 3> tile_mean;
  int width;  ///< From one row of pixels to the next.
};

/// Halves two or more adjacent whole tiles, and averages them.
/// @param from    the first pixel's blue byte.
/// @param stride  bytes from one row to the next.
void HalveTiles(const std::uint8_t* from, std::ptrdiff_t stride, int count, const HalvedTiles& to);

/// Averages a row of tiles of one channel.
/// @param pixels   kTileRows rows of `width` pixels.
/// @param columns  scratch memory for a row.
void AverageTiles(const std::uint8_t* pixels, int width, std::uint16_t* columns, float* means);

/// Averages variances, and squares of slopes, in a row of tiles.
/// @param variance, slope  kTileRows rows of `width` pixels.
/// @param columns          scratch memory for a row.
void AverageVariances(const float* variance, const std::uint8_t* slope, int width, float* columns,
                      float* mean_variance, float* mean_slope_sq);

}  // namespace mocap::kernels
