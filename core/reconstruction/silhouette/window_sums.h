// §4: distortions summed within windows, for eight adjacent pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/lanes.h"

namespace mocap {

/// Half the side of each window, without the pixel in the middle.
inline constexpr std::array<int, 2> kWindowRadii_px = {2, 3};
inline constexpr std::size_t kWindows = kWindowRadii_px.size();
inline constexpr int kLargestRadius_px = kWindowRadii_px.back();

/// For eight pixels of a line: sums along the line over the width of a window around each.
struct alignas(32) LineSums {
  using Column = std::array<float, kFloats>;
  Column alpha, alpha_sq;  ///< α − 1 and its square.
  Column moment;           ///< α − 1 times the distance to the right.
  std::array<Column, 3> cd;
};

/// For all windows around eight pixels.
using BlockSums = std::array<LineSums, kWindows>;
/// Number of lines in the windows around two pixels, one below the other.
inline constexpr int kPairLines = 2 * kLargestRadius_px + 2;
/// Number of lines of the same eight pixels that are stored together. Lines come a few at a time,
/// some of them before they are needed.
inline constexpr int kSumLines = kPairLines + 4;

/// The sums of the first blocks of two adjacent rows, and of the lines above and below that their
/// windows may need. Those of further blocks follow in steps of kSumLines.
using WindowLines = std::array<const BlockSums*, kPairLines>;

/// Deviation of the windows around eight pixels.
struct WindowDistortions {
  Floats alpha_shift;   ///< Mean of α − 1.
  Floats cd_sq;         ///< Squared length of the mean colour distance.
  Floats roughness_sq;  ///< Variance of α about a plane, divided by a².
};

/// Sums over the lines of a window.
struct WindowSums {
  /// The sums of one line, at a distance below the middle.
  MOCAP_INLINE WindowSums(const LineSums& line, float below) {
    LoadLanes(line.alpha.data(), alpha), LoadLanes(line.alpha_sq.data(), alpha_sq);
    LoadLanes(line.moment.data(), along);
    LoadLanes(line.cd[0].data(), cd0), LoadLanes(line.cd[1].data(), cd1);
    LoadLanes(line.cd[2].data(), cd2);
    down = below * alpha;
  }
  MOCAP_INLINE void Add(const WindowSums& line) {
    alpha += line.alpha, alpha_sq += line.alpha_sq, along += line.along, down += line.down;
    cd0 += line.cd0, cd1 += line.cd1, cd2 += line.cd2;
  }
  /// Moves the middle down by `by`.
  MOCAP_INLINE void MoveMiddle(float by) { down -= by * alpha; }

  Floats alpha, alpha_sq, along, down, cd0, cd1, cd2;
};

/// Measures a window of one size around each of eight pixels.
/// @param sums          of all lines of the window.
/// @param alpha_weight  1/a of the pixels.
template <std::size_t window>
MOCAP_INLINE void MeasureWindow(const WindowSums& sums, const Floats& alpha_weight,
                                WindowDistortions& result) {
  constexpr int kSide = 2 * kWindowRadii_px[window] + 1;
  constexpr float kArea = kSide * kSide;
  // Sum of x² over the window's pixels, relative to its centre.
  constexpr float kSpread = kArea * (kArea - 1) / 12;
  const auto& [alpha, alpha_sq, along, down, cd0, cd1, cd2] = sums;
  result.alpha_shift = alpha * (1 / kArea);
  const Floats squares =
      alpha_sq - alpha * result.alpha_shift - (along * along + down * down) * (1 / kSpread);
  result.roughness_sq = squares * (1 / kArea) * alpha_weight * alpha_weight;
  result.cd_sq = (cd0 * cd0 + cd1 * cd1 + cd2 * cd2) * (1 / (kArea * kArea));
}

/// Measures the windows of one size around eight pixels of each of two rows. They share all but the
/// outermost lines.
/// @param block         index in the rows.
/// @param alpha_weight  1/a of the pixels.
template <std::size_t window>
MOCAP_INLINE void JoinLines(const WindowLines& lines, int block,
                            const std::array<Floats, 2>& alpha_weight,
                            std::array<WindowDistortions, 2>& result) {
  constexpr int kRadius = kWindowRadii_px[window];
  const auto line_at = [&](int below_first) -> const LineSums& {
    return lines[below_first + kLargestRadius_px][block * kSumLines][window];
  };
  // From the middle between the rows.
  WindowSums upper(line_at(kRadius), kRadius - 0.5f);
#pragma GCC unroll 8
  for (int i = kRadius - 1; i > -kRadius; --i)
    upper.Add(WindowSums(line_at(i), static_cast<float>(i) - 0.5f));
  WindowSums lower = upper;
  upper.MoveMiddle(-0.5f), lower.MoveMiddle(0.5f);
  upper.Add(WindowSums(line_at(-kRadius), -kRadius));
  lower.Add(WindowSums(line_at(kRadius + 1), kRadius));
  MeasureWindow<window>(upper, alpha_weight[0], result[0]);
  MeasureWindow<window>(lower, alpha_weight[1], result[1]);
}

}  // namespace mocap
