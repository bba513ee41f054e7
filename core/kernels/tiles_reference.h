// What tiles.h means, pixel by pixel.
#pragma once

#include <algorithm>

#include "core/kernels/tiles.h"

namespace mocap::kernels::reference {

inline constexpr float kTileArea = kTileSide * kTileSide;

/// Values of the pixels of a tile.
using TileValues = std::array<std::array<float, kTileSide>, kTileSide>;

/// Sums in the order of the kernels: rows two apart, then columns two apart.
inline float SumOf(const TileValues& v) {
  std::array<float, kTileSide> s;
  for (int x = 0; x < kTileSide; ++x) s[x] = (v[0][x] + v[2][x]) + (v[1][x] + v[3][x]);
  return (s[0] + s[2]) + (s[1] + s[3]);
}

/// Deviation of the pixel `i` [variances].
inline float ChiSquareOf(const TilePixels& tiles, std::ptrdiff_t i, const Allowance& allowance,
                         float alpha) {
  float square = 0;
  for (int c = 0; c < 3; ++c) {
    const float d = allowance.gain[c] * tiles.live[c][i] - alpha * tiles.expected[c][i];
    square += d * d;
  }
  const float slope = tiles.slope[i];
  return square / (tiles.variance[i] + allowance.drift_sq + allowance.shift_sq * slope * slope);
}

inline void MeasureChiSquares(const TilePixels& tiles, int count, const Allowance& allowance,
                              const float* alphas, float* chi_squares) {
  for (int tile = 0; tile < count; ++tile) {
    std::array<float, kTileSide> columns{};
    for (int y = 0; y < kTileSide; ++y)
      for (int x = 0; x < kTileSide; ++x)
        columns[x] +=
            ChiSquareOf(tiles, tile * kTileSide + y * tiles.stride + x, allowance, alphas[tile]);
    chi_squares[tile] = (columns[0] + columns[1] + columns[2] + columns[3]) / kTileArea;
  }
}

inline void MeasureTile(const TileMeans& tiles, std::size_t i, const Allowance& allowance,
                        float& alpha, float& tint, float& glare) {
  float square = 0, along = 0, distance_sq = 0;
  for (int c = 0; c < 3; ++c) {
    square += tiles.expected[c][i] * tiles.expected[c][i];
    along += allowance.gain[c] * tiles.live[c][i] * tiles.expected[c][i];
  }
  square = std::max(square, 1.0f);
  alpha = along / square;
  for (int c = 0; c < 3; ++c) {
    const float d = allowance.gain[c] * tiles.live[c][i] - alpha * tiles.expected[c][i];
    distance_sq += d * d;
  }
  const float weight =
      1 / (tiles.variance[i] + allowance.drift_sq + allowance.shift_sq * tiles.slope_sq[i]);
  const float bright = std::max(alpha - 1, 0.0f);
  tint = distance_sq * weight;
  glare = bright * bright * square * weight;
}

inline float ChiSquareBesideSlope(const TilePixels& tile, const Allowance& allowance) {
  // The sum of x² over a tile's pixels, relative to its centre.
  constexpr float kSpread = kTileArea * (kTileArea - 1) / 12;
  const auto from_middle = [](int i) { return static_cast<float>(i) - 1.5f; };
  TileValues alphas, to_right, to_bottom, squares;
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      const std::ptrdiff_t i = y * tile.stride + x;
      float along = 0, square = 1;
      for (int c = 0; c < 3; ++c) {
        const float expected = tile.expected[c][i];
        along += allowance.gain[c] * tile.live[c][i] * expected;
        square += expected * expected;
      }
      alphas[y][x] = along / square;
    }
  }
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      to_right[y][x] = (alphas[y][x] + alphas[y + 2][x]) * from_middle(x);
      to_bottom[y][x] = alphas[y][x] * from_middle(y) + alphas[y + 2][x] * from_middle(y + 2);
    }
  }
  // The upper two rows hold the sums with the lower two. Zeros leave them as they are.
  std::fill_n(to_right.begin() + 2, 2, std::array<float, kTileSide>{});
  std::fill_n(to_bottom.begin() + 2, 2, std::array<float, kTileSide>{});
  const float middle = SumOf(alphas) / kTileArea;
  const float rightwards = SumOf(to_right) / kSpread, downwards = SumOf(to_bottom) / kSpread;
  for (int y = 0; y < kTileSide; ++y) {
    for (int x = 0; x < kTileSide; ++x) {
      float plane = middle + rightwards * from_middle(x) + downwards * from_middle(y % 2);
      if (y >= 2) plane = plane + 2 * downwards;
      squares[y][x] = ChiSquareOf(tile, y * tile.stride + x, allowance, plane);
    }
  }
  return SumOf(squares) / kTileArea;
}

}  // namespace mocap::kernels::reference
