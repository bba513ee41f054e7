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

// A row of two tiles side by side.
static_assert(kFloats == 2 * kTile);

MOCAP_INLINE Floats LoadRow(const std::uint8_t* from) {
  std::int32_t left, right;
  std::memcpy(&left, from, sizeof left), std::memcpy(&right, from + kTile, sizeof right);
  static_assert(std::endian::native == std::endian::little);
  const Ints rows = __builtin_shufflevector(AllOf(left), AllOf(right), 0, 1, 2, 3, 12, 13, 14, 15);
  return ToFloats(rows >> Ints{0, 8, 16, 24, 0, 8, 16, 24} & 0xff);
}

// How a row of two tiles, from such a pixel on, differs.
MOCAP_INLINE Floats MisfitsOfRow(const TilePixels& tiles, std::ptrdiff_t first,
                                 const Allowance& allowance, Floats alphas) {
  Floats squares{}, variances;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const Floats d = allowance.gain[c] * LoadRow(tiles.live[c] + first) -
                     alphas * LoadRow(tiles.expected[c] + first);
    squares += d * d;
  }
  const Floats slope = LoadRow(tiles.slope + first);
  LoadLanes(tiles.variance + first, variances);
  return squares / (variances + allowance.drift_sq + allowance.shift_sq * slope * slope);
}

}  // namespace

MOCAP_VECTORIZED
void MeasureMisfits(const TilePixels& tiles, int count, const Allowance& allowance,
                    const float* alphas, float* misfits) {
  const Allowance allowed = allowance;  // As far as the compiler knows, the results may lie there.
  for (int i = 0; i < count; i += 2) {
    const bool is_last = i + 1 == count;
    const float left = alphas[i], right = is_last ? left : alphas[i + 1];
    const Floats both = {left, left, left, left, right, right, right, right};
    Floats sums{};
#pragma GCC unroll 4
    for (int y = 0; y < kTile; ++y)
      sums += MisfitsOfRow(tiles, i * kTile + y * tiles.stride, allowed, both);
    std::array<float, kFloats> columns;
    StoreLanes(sums, columns.data());
    misfits[i] = (columns[0] + columns[1] + columns[2] + columns[3]) / kArea;
    if (is_last) break;
    misfits[i + 1] = (columns[4] + columns[5] + columns[6] + columns[7]) / kArea;
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
