#include "core/kernels/tiles.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/tiles.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

constexpr int kTile = kTileSide;
constexpr float kArea = kTilePixels;

void MeasureAllTiles(const TileMeans& tiles, int count, const Allowance& allowance,
                     const TileDeviations& to) {
  const auto [gain0, gain1, gain2] = allowance.gain;
  const float drift_sq = allowance.drift_sq, shift_sq = allowance.shift_sq;
  const auto [l0, l1, l2] = tiles.live;
  const auto [e0, e1, e2] = tiles.expected;
  const float *const variances = tiles.variance, *const slope_sq = tiles.slope_sq;
  const auto [alphas, tints, glares, weights] = to;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float c0 = gain0 * l0[i], c1 = gain1 * l1[i], c2 = gain2 * l2[i];
    const float square = std::max(e0[i] * e0[i] + e1[i] * e1[i] + e2[i] * e2[i], 1.0f);
    const float alpha = (c0 * e0[i] + c1 * e1[i] + c2 * e2[i]) / square;
    const float d0 = c0 - alpha * e0[i], d1 = c1 - alpha * e1[i], d2 = c2 - alpha * e2[i];
    const float weight = 1 / (variances[i] + drift_sq + shift_sq * slope_sq[i]);
    const float bright = std::max(alpha - 1, 0.0f);
    alphas[i] = alpha;
    tints[i] = (d0 * d0 + d1 * d1 + d2 * d2) * weight;
    glares[i] = bright * bright * square * weight;
    weights[i] = weight;
  }
}

void MeasureAllChiSquares(const TilePixels& tiles, int count, const std::array<float, 3>& gain,
                          const float* alphas, const float* weights, float* scratch,
                          float* chi_squares) {
  const int width = count * kTile;
  float *const alpha = scratch, *const columns = scratch + width;
  for (int x = 0; x < width; ++x) alpha[x] = alphas[x / kTile];
  std::fill_n(columns, width, 0.0f);
  for (int y = 0; y < kTileRows; ++y) {
    for (int c = 0; c < 3; ++c) {
      const std::uint8_t* const live = tiles.live[c] + y * tiles.stride;
      const std::uint8_t* const expected = tiles.expected[c] + y * tiles.stride;
      const float channel_gain = gain[c];
#pragma GCC ivdep
      for (int x = 0; x < width; ++x) {
        const float difference = channel_gain * live[x] - alpha[x] * expected[x];
        columns[x] += difference * difference;
      }
    }
  }
  for (int i = 0; i < count; ++i) {
    const float* const c = columns + i * kTile;
    chi_squares[i] = (c[0] + c[1] + c[2] + c[3]) / kArea * weights[i];
  }
}

// Places of a tile's pixels, from its centre.
HWY_INLINE float RightOf(int i) { return static_cast<float>(i % kTile) - (kTile - 1) / 2.0f; }
HWY_INLINE float Below(int i) { return static_cast<float>(i / kTile) - (kTileRows - 1) / 2.0f; }

float ChiSquareOfPlane(const TilePixels& tile, const std::array<float, 3>& gain, float weight) {
  // Sums of x² and of y² over a tile's pixels, relative to its centre.
  constexpr float kSpreadX = kArea * (kTile * kTile - 1) / 12;
  constexpr float kSpreadY = kArea * (kTileRows * kTileRows - 1) / 12;
  std::array<float, kTilePixels> along{}, square{}, squares{};
  float middle = 0, to_right = 0, to_bottom = 0;
  for (int i = 0; i < kTilePixels; ++i) {
    square[i] = 1;
    for (int c = 0; c < 3; ++c) {
      const int at = i / kTile * tile.stride + i % kTile;
      const float expected = tile.expected[c][at];
      along[i] += gain[c] * tile.live[c][at] * expected;
      square[i] += expected * expected;
    }
  }
  for (int i = 0; i < kTilePixels; ++i) {
    const float alpha = along[i] / square[i];
    middle += alpha, to_right += alpha * RightOf(i), to_bottom += alpha * Below(i);
  }
  const float downwards = std::clamp(to_bottom / kSpreadY, -kSteepestShadow, kSteepestShadow);
  float sum = 0;
  for (int i = 0; i < kTilePixels; ++i) {
    const float plane = middle / kArea + to_right / kSpreadX * RightOf(i) + downwards * Below(i);
    for (int c = 0; c < 3; ++c) {
      const int at = i / kTile * tile.stride + i % kTile;
      const float difference = gain[c] * tile.live[c][at] - plane * tile.expected[c][at];
      squares[i] += difference * difference;
    }
    sum += squares[i];
  }
  return sum / kArea * weight;
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(MeasureAllTiles);
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance,
                  const TileDeviations& to) {
  HWY_DYNAMIC_DISPATCH(MeasureAllTiles)(tiles, count, allowance, to);
}

HWY_EXPORT(MeasureAllChiSquares);
void MeasureChiSquares(const TilePixels& tiles, int count, const std::array<float, 3>& gain,
                       const float* alphas, const float* weights, float* scratch,
                       float* chi_squares) {
  HWY_DYNAMIC_DISPATCH(MeasureAllChiSquares)
  (tiles, count, gain, alphas, weights, scratch, chi_squares);
}

HWY_EXPORT(ChiSquareOfPlane);
float ChiSquareBesideSlope(const TilePixels& tile, const std::array<float, 3>& gain, float weight) {
  return HWY_DYNAMIC_DISPATCH(ChiSquareOfPlane)(tile, gain, weight);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
