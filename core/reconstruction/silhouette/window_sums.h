// §4: distortions summed within windows, eight pixels side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/lanes.h"

namespace mocap {

/// Half the windows' sides, without the pixel in the middle.
inline constexpr std::array<int, 2> kWindowRadii_px = {2, 3};
inline constexpr std::size_t kWindows = kWindowRadii_px.size();
inline constexpr int kLargestRadius_px = kWindowRadii_px.back();

/// Of eight pixels of a line: sums along the line within the width of a window around each.
struct alignas(32) LineSums {
  using Column = std::array<float, kFloats>;
  Column alpha, alpha_sq;  ///< α − 1 and its square.
  Column moment;           ///< α − 1 times the distance to the right.
  std::array<Column, 3> cd;
};

/// Of all windows around eight pixels.
using BlockSums = std::array<LineSums, kWindows>;
/// So many lines of the same eight pixels lie together.
inline constexpr int kSumLines = 2 * kLargestRadius_px + 2;

/// The sums of a row's first block, and of the lines above and below that its windows may need:
/// those of its other blocks follow in steps of kSumLines.
using WindowLines = std::array<const BlockSums*, 2 * kLargestRadius_px + 1>;

/// How the windows around eight pixels differ.
struct WindowDistortions {
  Floats alpha_shift;   ///< Mean of α − 1.
  Floats cd_sq;         ///< Squared length of the mean colour distance.
  Floats roughness_sq;  ///< Variance of α about a plane, divided by a².
};

/// Measures the windows of one size around eight pixels.
/// @param block         of the row.
/// @param alpha_weight  1/a of the pixels.
template <std::size_t window>
MOCAP_INLINE void JoinLines(const WindowLines& lines, int block, const Floats& alpha_weight,
                            WindowDistortions& result) {
  constexpr int kRadius = kWindowRadii_px[window];
  constexpr float kArea = (2 * kRadius + 1) * (2 * kRadius + 1);
  // Sum of x² over the window's pixels, counted from its middle.
  constexpr float kSpread = kArea * (kArea - 1) / 12;
  Floats alpha{}, alpha_sq{}, along{}, down{}, cd0{}, cd1{}, cd2{};
#pragma GCC unroll 7
  for (int i = kRadius; i >= -kRadius; --i) {
    const LineSums& line = lines[i + kLargestRadius_px][block * kSumLines][window];
    Floats a, a_sq, moment, c0, c1, c2;
    LoadLanes(line.alpha.data(), a), LoadLanes(line.alpha_sq.data(), a_sq);
    LoadLanes(line.moment.data(), moment);
    LoadLanes(line.cd[0].data(), c0), LoadLanes(line.cd[1].data(), c1);
    LoadLanes(line.cd[2].data(), c2);
    alpha += a, alpha_sq += a_sq, along += moment, down += static_cast<float>(i) * a;
    cd0 += c0, cd1 += c1, cd2 += c2;
  }
  result.alpha_shift = alpha * (1 / kArea);
  const Floats squares =
      alpha_sq - alpha * result.alpha_shift - (along * along + down * down) * (1 / kSpread);
  result.roughness_sq = squares * (1 / kArea) * alpha_weight * alpha_weight;
  result.cd_sq = (cd0 * cd0 + cd1 * cd1 + cd2 * cd2) * (1 / (kArea * kArea));
}

}  // namespace mocap
