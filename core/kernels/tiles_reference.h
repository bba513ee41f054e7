// What tiles.h means, pixel by pixel.
#pragma once

#include <algorithm>

#include "core/kernels/tiles.h"

namespace mocap::kernels::reference {

inline void MeasureTile(const TileMeans& tiles, std::size_t i, const Allowance& allowance,
                        const TileDeviations& to) {
  float square = 0, along = 0, distance_sq = 0;
  for (int c = 0; c < 3; ++c) {
    square += tiles.expected[c][i] * tiles.expected[c][i];
    along += allowance.gain[c] * tiles.live[c][i] * tiles.expected[c][i];
  }
  square = std::max(square, 1.0f);
  const float alpha = along / square;
  for (int c = 0; c < 3; ++c) {
    const float d = allowance.gain[c] * tiles.live[c][i] - alpha * tiles.expected[c][i];
    distance_sq += d * d;
  }
  const float weight =
      1 / (tiles.variance[i] + allowance.drift_sq + allowance.shift_sq * tiles.slope_sq[i]);
  const float bright = std::max(alpha - 1, 0.0f);
  to.alpha[i] = alpha;
  to.tint[i] = distance_sq * weight;
  to.glare[i] = bright * bright * square * weight;
  to.weight[i] = weight;
}

/// Chi-square of the first tile. The kernel sums its columns first.
inline float ChiSquareOf(const TilePixels& tile, const std::array<float, 3>& gain, float alpha,
                         float weight) {
  std::array<float, kTileSide> columns{};
  for (int y = 0; y < kTileRows; ++y) {
    for (int c = 0; c < 3; ++c) {
      for (int x = 0; x < kTileSide; ++x) {
        const int i = y * tile.stride + x;
        const float d = gain[c] * tile.live[c][i] - alpha * tile.expected[c][i];
        columns[x] += d * d;
      }
    }
  }
  return (columns[0] + columns[1] + columns[2] + columns[3]) / kTilePixels * weight;
}

}  // namespace mocap::kernels::reference
