// §4: deviation of tiles from the empty studio, at half the resolution.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/kernels/halving.h"

namespace mocap::kernels {

/// Deviations of the whole picture, which do not count as a deviation of a tile.
struct Allowance {
  std::array<float, 3> gain{1, 1, 1};  ///< Of blue, green, red.
  float drift_sq = 0;                  ///< Added to each variance [grey levels²].
  float shift_sq = 0;  ///< Multiplies a slope's square, which is also added [pixels²].
};

/// Pixels of adjacent tiles, per channel, from the first pixel of the first tile on. One more tile
/// must be readable after the last.
struct TilePixels {
  std::array<const std::uint8_t*, 3> live, expected;
  const float* variance;
  const std::uint8_t* slope;
  int stride;  ///< From one row to the next.
};

/// Measures the mean squared deviation of tiles' pixels, in variances, relative to their tile's
/// brightness.
/// @param alphas  the tiles' brightness distortion.
void MeasureChiSquares(const TilePixels& tiles, int count, const Allowance& allowance,
                       const float* alphas, float* chi_squares);

/// Means of tiles, per channel.
struct TileMeans {
  std::array<const float*, 3> live, expected;
  const float *variance, *slope_sq;
};

/// Measures the brightness distortion of tiles, and how many variances they are tinted or brighter.
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance, float* alphas,
                  float* tints, float* glares);

/// Measures the mean chi-square of a tile's pixels [variances]. Brightness may change evenly across
/// the tile, as at the soft edge of a shadow.
float ChiSquareBesideSlope(const TilePixels& tile, const Allowance& allowance);

}  // namespace mocap::kernels
