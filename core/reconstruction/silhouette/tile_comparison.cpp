#include "core/reconstruction/silhouette/tile_comparison.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>

#include "core/lanes.h"

namespace mocap {
namespace {

constexpr int kTile = HalfPicture::kTile;
constexpr float kArea = kTile * kTile;
// Where a tile's middle is, and the sum of x² over its pixels counted from there.
constexpr float kMiddle = (kTile - 1) / 2.0f;
constexpr float kSpread = kArea * (kArea - 1) / 12;

// A plane over a tile, from its middle.
struct Slope {
  float At(int x, int y) const { return middle + right * (x - kMiddle) + down * (y - kMiddle); }
  void Add(int x, int y, float value) {
    middle += value / kArea;
    right += value * (x - kMiddle) / kSpread;
    down += value * (y - kMiddle) / kSpread;
  }
  float middle = 0, right = 0, down = 0;
};

using Row = float __attribute__((vector_size(kTile * sizeof(float))));

// Two rows of a tile, one after the other.
static_assert(kFloats == 2 * kTile);

MOCAP_INLINE Floats LoadRows(const std::uint8_t* first, int stride) {
  std::int32_t top, bottom;
  std::memcpy(&top, first, sizeof top), std::memcpy(&bottom, first + stride, sizeof bottom);
  const Ints rows =
      __builtin_shufflevector(Ints{} + top, Ints{} + bottom, 0, 1, 2, 3, 12, 13, 14, 15);
  static_assert(std::endian::native == std::endian::little);
  return __builtin_convertvector(rows >> Ints{0, 8, 16, 24, 0, 8, 16, 24} & 0xff, Floats);
}

MOCAP_INLINE Floats LoadRows(const float* first, int stride) {
  Row top, bottom;
  LoadLanes(first, top), LoadLanes(first + stride, bottom);
  return __builtin_shufflevector(top, bottom, 0, 1, 2, 3, 4, 5, 6, 7);
}

// How two rows of a tile, from such a pixel on, differ.
MOCAP_INLINE Floats MisfitsOfRows(const TilePixels& tiles, std::ptrdiff_t first,
                                  const Allowance& allowance, float alpha) {
  Floats squares{};
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const Floats d = allowance.gain[c] * LoadRows(tiles.live[c] + first, tiles.stride) -
                     alpha * LoadRows(tiles.expected[c] + first, tiles.stride);
    squares += d * d;
  }
  const Floats slope = LoadRows(tiles.slope + first, tiles.stride);
  return squares / (LoadRows(tiles.variance + first, tiles.stride) + allowance.drift_sq +
                    allowance.shift_sq * slope * slope);
}

}  // namespace

MOCAP_VECTORIZED
void MeasureMisfits(const TilePixels& tiles, int count, const Allowance& allowance,
                    const float* alphas, float* misfits) {
  const Allowance allowed = allowance;  // As far as the compiler knows, the results may lie there.
  for (int i = 0; i < count; ++i) {
    const Floats upper = MisfitsOfRows(tiles, i * kTile, allowed, alphas[i]);
    const Floats lower = MisfitsOfRows(tiles, i * kTile + 2 * tiles.stride, allowed, alphas[i]);
    std::array<float, kTile> columns;
    StoreLanes(__builtin_shufflevector(upper, upper, 0, 1, 2, 3) +
                   __builtin_shufflevector(upper, upper, 4, 5, 6, 7) +
                   __builtin_shufflevector(lower, lower, 0, 1, 2, 3) +
                   __builtin_shufflevector(lower, lower, 4, 5, 6, 7),
               columns.data());
    misfits[i] = (columns[0] + columns[1] + columns[2] + columns[3]) / kArea;
  }
}

MOCAP_VECTORIZED
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance, float* alphas,
                  float* tints, float* glares) {
  const auto [gain0, gain1, gain2] = allowance.gain;
  const float drift_sq = allowance.drift_sq, shift_sq = allowance.shift_sq;
  const auto [l0, l1, l2] = tiles.live;
  const auto [e0, e1, e2] = tiles.expected;
  const float *const variances = tiles.variance, *const slope_sq = tiles.slope_sq;
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
  }
}

float MisfitBesideSlope(const HalfPicture& live, const ExpectedHalf& expected, int tile_row,
                        int tile_column, const Allowance& allowance) {
  const std::size_t first =
      static_cast<std::size_t>(tile_row) * kTile * live.width + tile_column * kTile;
  const auto index = [&](int x, int y) {
    return first + static_cast<std::size_t>(y) * live.width + x;
  };
  Slope brightness;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      float along = 0, square = 1;
      for (int c = 0; c < 3; ++c) {
        const float e = expected.mean.color[c][index(x, y)];
        along += allowance.gain[c] * live.color[c][index(x, y)] * e;
        square += e * e;
      }
      brightness.Add(x, y, along / square);
    }
  }
  float misfit = 0;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const std::size_t i = index(x, y);
      const float slope = expected.slope[i];
      const float variance =
          expected.variance[i] + allowance.drift_sq + allowance.shift_sq * slope * slope;
      for (int c = 0; c < 3; ++c) {
        const float d =
            allowance.gain[c] * live.color[c][i] - brightness.At(x, y) * expected.mean.color[c][i];
        misfit += d * d / variance;
      }
    }
  }
  return misfit / kArea;
}

}  // namespace mocap
