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

/// A row of pixels, channel by channel.
struct PixelRow {
  std::array<const std::uint8_t*, 3> live, expected;
  const float* variance;
  const std::uint8_t* slope;
  const float* alpha;  ///< The brightness distortion of each pixel's tile.
};

/// Adds to `sums` by how many variances pixels differ from what is expected, but for their tile's
/// brightness.
void AddMisfits(const PixelRow& row, int width, const Allowance& allowance, float* sums);

/// Means of tiles, channel by channel.
struct TileMeans {
  std::array<const float*, 3> live, expected;
  const float *variance, *slope_sq;
};

/// Measures the brightness distortion of tiles, and by how many variances they are coloured
/// differently or brighter.
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance, float* alphas,
                  float* tints, float* glares);

/// Measures the mean misfit of a tile's pixels where brightness may change evenly across it, as at
/// the soft edge of a shadow [variances].
float MisfitBesideSlope(const HalfPicture& live, const ExpectedHalf& expected, int tile_row,
                        int tile_column, const Allowance& allowance);

}  // namespace mocap
