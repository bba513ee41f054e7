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

/// Means of tiles, per channel, and their variances and squared slopes.
struct TileMeans {
  std::array<const float*, 3> live, expected;
  const float *variance, *slope_sq;
};

/// Deviations of tiles.
struct TileDeviations {
  float* alpha;   ///< Brightness distortion.
  float* tint;    ///< Of the colour [variances].
  float* glare;   ///< Of the brightness, if it is larger [variances].
  float* weight;  ///< 1 / variance.
};

/// Measures tiles by their means.
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance,
                  const TileDeviations& to);

/// Pixels of adjacent tiles, per channel, from the first pixel of the first tile on.
struct TilePixels {
  std::array<const std::uint8_t*, 3> live, expected;
  int stride;  ///< From one row to the next.
};

/// Measures the mean squared deviation of tiles' pixels, in variances, relative to their tile's
/// brightness.
/// @param scratch  memory for two numbers for each pixel of a row.
void MeasureChiSquares(const TilePixels& tiles, int count, const std::array<float, 3>& gain,
                       const float* alphas, const float* weights, float* scratch,
                       float* chi_squares);

/// Two rows fit any slope. Steeper ones [change of the brightness distortion from row to row] are
/// edges of things, not of shadows.
inline constexpr float kSteepestShadow = 0.08f;

/// Measures it for one tile, whose brightness may change evenly across it, as at the soft edge of a
/// shadow.
float ChiSquareBesideSlope(const TilePixels& tile, const std::array<float, 3>& gain, float weight);

}  // namespace mocap::kernels
