#include "core/kernels/tiles.h"

#include <algorithm>

#include "core/kernels/tiles_reference.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/tiles.cpp"
#include "core/kernels/each_target.h"
#include "core/kernels/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

constexpr int kTile = kTileSide;
constexpr float kArea = kTile * kTile;

// Deviations of adjacent pixels from pixel `i` on, in variances.
template <typename D, typename V = hn::Vec<D>>
HWY_INLINE V ChiSquares(D d, const TilePixels& tiles, std::ptrdiff_t i, const Allowance& allowance,
                        V alphas) {
  V squares = hn::Zero(d);
  for (int c = 0; c < 3; ++c) {
    const V difference = hn::Set(d, allowance.gain[c]) * LoadAsFloats(d, tiles.live[c] + i) -
                         alphas * LoadAsFloats(d, tiles.expected[c] + i);
    squares = squares + difference * difference;
  }
  const V slope = LoadAsFloats(d, tiles.slope + i);
  return squares / (hn::LoadU(d, tiles.variance + i) + hn::Set(d, allowance.drift_sq) +
                    hn::Set(d, allowance.shift_sq) * slope * slope);
}

// Two tiles are measured at once.
void MeasureAllChiSquares(const TilePixels& tiles, int count, const Allowance& allowance,
                          const float* alphas, float* chi_squares) {
  constexpr FloatsUpTo<2 * kTile> d;
  const Allowance allowed = allowance;  // A copy: the compiler must expect aliasing results.
  for (int i = 0; i < count; i += 2) {
    const bool is_last = i + 1 == count;
    alignas(32) std::array<float, 2 * kTile> alpha, columns;
    std::fill_n(alpha.begin(), kTile, alphas[i]);
    std::fill_n(alpha.begin() + kTile, kTile, alphas[is_last ? i : i + 1]);
    for (std::size_t k = 0; k < 2 * kTile; k += hn::MaxLanes(d)) {
      const auto both = hn::Load(d, &alpha[k]);
      auto sums = hn::Zero(d);
      for (int y = 0; y < kTile; ++y)
        sums = sums + ChiSquares(d, tiles, i * kTile + y * tiles.stride + k, allowed, both);
      hn::Store(sums, d, &columns[k]);
    }
    chi_squares[i] = (columns[0] + columns[1] + columns[2] + columns[3]) / kArea;
    if (is_last) break;
    chi_squares[i + 1] = (columns[4] + columns[5] + columns[6] + columns[7]) / kArea;
  }
}

void MeasureAllTiles(const TileMeans& tiles, int count, const Allowance& allowance, float* alphas,
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

#if HWY_TARGET == HWY_SCALAR

float ChiSquareOfPlane(const TilePixels& tile, const Allowance& allowance) {
  return reference::ChiSquareBesideSlope(tile, allowance);
}

#else

using Row = hn::Vec<hn::FixedTag<float, kTile>>;

HWY_INLINE float SumOf(Row row) {
  const Row sums = row + hn::Shuffle1032(row);
  return hn::GetLane(sums) + hn::GetLane(hn::Shuffle2301(sums));
}

// The brightness distortion of a row of pixels.
HWY_INLINE Row AlphasOf(const TilePixels& tile, std::ptrdiff_t i, const Allowance& allowance) {
  constexpr hn::FixedTag<float, kTile> d;
  Row along = hn::Zero(d), square = hn::Set(d, 1);
  for (int c = 0; c < 3; ++c) {
    const Row expected = LoadAsFloats(d, tile.expected[c] + i);
    along = along + hn::Set(d, allowance.gain[c]) * LoadAsFloats(d, tile.live[c] + i) * expected;
    square = square + expected * expected;
  }
  return along / square;
}

float ChiSquareOfPlane(const TilePixels& tile, const Allowance& allowance) {
  // The sum of x² over a tile's pixels, relative to its centre.
  constexpr float kSpread = kArea * (kArea - 1) / 12;
  constexpr std::array<float, kTile> kFromMiddle = {-1.5f, -0.5f, 0.5f, 1.5f};
  constexpr hn::FixedTag<float, kTile> d;
  const Row right = hn::LoadU(d, kFromMiddle.data());
  Row rows[kTile];
  for (int y = 0; y < kTile; ++y) rows[y] = AlphasOf(tile, y * tile.stride, allowance);
  // Fits a plane to the tile. Rows two apart are summed first.
  const Row first = rows[0] + rows[2], second = rows[1] + rows[3];
  const float middle = SumOf(first + second) / kArea;
  const float to_right = SumOf(first * right + second * right) / kSpread;
  const float to_bottom =
      SumOf((rows[0] * hn::Set(d, kFromMiddle[0]) + rows[2] * hn::Set(d, kFromMiddle[2])) +
            (rows[1] * hn::Set(d, kFromMiddle[1]) + rows[3] * hn::Set(d, kFromMiddle[3]))) /
      kSpread;
  Row squares[kTile];
  for (int y = 0; y < kTile; ++y) {
    Row plane = hn::Set(d, middle) + hn::Set(d, to_right) * right +
                hn::Set(d, to_bottom * kFromMiddle[y % 2]);
    if (y >= 2) plane = plane + hn::Set(d, 2 * to_bottom);
    squares[y] = ChiSquares(d, tile, y * tile.stride, allowance, plane);
  }
  return SumOf((squares[0] + squares[2]) + (squares[1] + squares[3])) / kArea;
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(MeasureAllChiSquares);
void MeasureChiSquares(const TilePixels& tiles, int count, const Allowance& allowance,
                       const float* alphas, float* chi_squares) {
  HWY_DYNAMIC_DISPATCH(MeasureAllChiSquares)(tiles, count, allowance, alphas, chi_squares);
}

HWY_EXPORT(MeasureAllTiles);
void MeasureTiles(const TileMeans& tiles, int count, const Allowance& allowance, float* alphas,
                  float* tints, float* glares) {
  HWY_DYNAMIC_DISPATCH(MeasureAllTiles)(tiles, count, allowance, alphas, tints, glares);
}

HWY_EXPORT(ChiSquareOfPlane);
float ChiSquareBesideSlope(const TilePixels& tile, const Allowance& allowance) {
  return HWY_DYNAMIC_DISPATCH(ChiSquareOfPlane)(tile, allowance);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
