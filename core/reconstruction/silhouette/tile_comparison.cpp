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
// The sum of x² over a tile's pixels, relative to its centre.
constexpr float kSpread = kArea * (kArea - 1) / 12;

// Two rows of a tile's side, the second `step` bytes further on: of two adjacent tiles, or one
// below the other.
static_assert(kFloats == 2 * kTile);
using Row = float __attribute__((vector_size(kTile * sizeof(float))));

MOCAP_INLINE Floats LoadRows(const std::uint8_t* from, std::ptrdiff_t step) {
  std::int32_t first, second;
  std::memcpy(&first, from, sizeof first), std::memcpy(&second, from + step, sizeof second);
  static_assert(std::endian::native == std::endian::little);
  const Ints rows =
      __builtin_shufflevector(AllOf(first), AllOf(second), 0, 1, 2, 3, 12, 13, 14, 15);
  return ToFloats(rows >> Ints{0, 8, 16, 24, 0, 8, 16, 24} & 0xff);
}
MOCAP_INLINE Floats LoadRows(const float* from, std::ptrdiff_t step) {
  Row first, second;
  LoadLanes(from, first), LoadLanes(from + step, second);
  return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}
MOCAP_INLINE float SumOf(Floats rows) {
  Row sums = __builtin_shufflevector(rows, rows, 0, 1, 2, 3) +
             __builtin_shufflevector(rows, rows, 4, 5, 6, 7);
  sums += __builtin_shufflevector(sums, sums, 2, 3, 0, 1);
  return sums[0] + sums[1];
}

// Deviation of two rows from a pixel on, in variances.
MOCAP_INLINE Floats ChiSquaresOfRows(const TilePixels& tiles, std::ptrdiff_t begin,
                                     std::ptrdiff_t step, const Allowance& allowance,
                                     Floats alphas) {
  Floats squares{};
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const Floats d = allowance.gain[c] * LoadRows(tiles.live[c] + begin, step) -
                     alphas * LoadRows(tiles.expected[c] + begin, step);
    squares += d * d;
  }
  const Floats slope = LoadRows(tiles.slope + begin, step);
  return squares / (LoadRows(tiles.variance + begin, step) + allowance.drift_sq +
                    allowance.shift_sq * slope * slope);
}

// The brightness distortion of the pixels in two rows of a tile.
MOCAP_INLINE Floats AlphasOfRows(const TilePixels& tile, std::ptrdiff_t begin,
                                 const Allowance& allowance) {
  Floats along{}, square = AllOf(1.0f);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const Floats expected = LoadRows(tile.expected[c] + begin, tile.stride);
    along += allowance.gain[c] * LoadRows(tile.live[c] + begin, tile.stride) * expected;
    square += expected * expected;
  }
  return along / square;
}

}  // namespace

MOCAP_VECTORIZED
void MeasureChiSquares(const TilePixels& tiles, int count, const Allowance& allowance,
                       const float* alphas, float* chi_squares) {
  const Allowance allowed = allowance;  // A copy: the compiler must expect aliasing results.
  for (int i = 0; i < count; i += 2) {
    const bool is_last = i + 1 == count;
    const float left = alphas[i], right = is_last ? left : alphas[i + 1];
    const Floats both = {left, left, left, left, right, right, right, right};
    Floats sums{};
#pragma GCC unroll 4
    for (int y = 0; y < kTile; ++y)
      sums += ChiSquaresOfRows(tiles, i * kTile + y * tiles.stride, kTile, allowed, both);
    std::array<float, kFloats> columns;
    StoreLanes(sums, columns.data());
    chi_squares[i] = (columns[0] + columns[1] + columns[2] + columns[3]) / kArea;
    if (is_last) break;
    chi_squares[i + 1] = (columns[4] + columns[5] + columns[6] + columns[7]) / kArea;
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

MOCAP_VECTORIZED
float ChiSquareBesideSlope(const TilePixels& tile, const Allowance& allowance) {
  // Positions of the pixels of the upper two rows, relative to the tile's centre.
  const Floats right = {-1.5f, -0.5f, 0.5f, 1.5f, -1.5f, -0.5f, 0.5f, 1.5f};
  const Floats down = {-1.5f, -1.5f, -1.5f, -1.5f, -0.5f, -0.5f, -0.5f, -0.5f};
  const std::ptrdiff_t lower = 2 * tile.stride;
  const Floats upper_alphas = AlphasOfRows(tile, 0, allowance);
  const Floats lower_alphas = AlphasOfRows(tile, lower, allowance);
  // Fits a plane to the tile.
  const Floats columns = upper_alphas + lower_alphas;
  const float middle = SumOf(columns) / kArea;
  const float to_right = SumOf(columns * right) / kSpread;
  const float to_bottom = SumOf(upper_alphas * down + lower_alphas * (down + 2)) / kSpread;
  const Floats upper_plane = middle + to_right * right + to_bottom * down;
  return SumOf(ChiSquaresOfRows(tile, 0, tile.stride, allowance, upper_plane) +
               ChiSquaresOfRows(tile, lower, tile.stride, allowance, upper_plane + 2 * to_bottom)) /
         kArea;
}

}  // namespace mocap
