// §4: how much tiles of a picture at half the resolution differ from the empty studio.
#pragma once

#include <array>
#include <cstdint>

#include "core/reconstruction/background/half_picture.h"

namespace mocap {

/// How a whole picture differs, which is no difference of any tile.
struct Allowance {
  std::array<float, 3> gain{1, 1, 1};  ///< Of blue, green, red.
  float drift_sq = 0;                  ///< Part of each variance [grey levels²].
  float shift_sq = 0;                  ///< So many times a slope's square is, too [pixels²].
};

/// Pixels of tiles that lie side by side, channel by channel, from the first tile's first on.
/// Behind the last tile as many can be read.
struct TilePixels {
  std::array<const std::uint8_t*, 3> live, expected;
  const float* variance;
  const std::uint8_t* slope;
  int stride;  ///< From a row to the next.
};

/// Measures by how many variances the pixels of tiles differ from what is expected in the mean, but
/// for their tile's brightness.
/// @param alphas  the tiles' brightness distortion.
void MeasureChiSquares(const TilePixels& tiles, int count, const Allowance& allowance,
                       const float* alphas, float* chi_squares);

/// Means of tiles, channel by channel.
struct TileMeans {
  std::array<const float*, 3> live, expected;
  const float *variance, *slope_sq;
};

/// Measures the brightness distortion of tiles, and by how many variances they are coloured
/// differently or brighter.
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance, float* alphas,
                  float* tints, float* glares);

/// Measures the mean chi-square of a tile's pixels where brightness may change evenly across it, as
/// at the soft edge of a shadow [variances].
float ChiSquareBesideSlope(const TilePixels& tile, const Allowance& allowance);

}  // namespace mocap
