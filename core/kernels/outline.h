// §4: whether a person covers half of a pixel beside the outline.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/image.h"
#include "core/kernels/bits.h"
#include "core/kernels/distortions.h"

namespace mocap::kernels {

/// Eight adjacent pixels of two adjacent rows are judged at once: four blocks of two by two, and
/// half a block on both sides. Pixels of a block are so close together that they share their
/// surroundings, which reach this far beyond it.
inline constexpr int kOutlineBlock_px = 2;
inline constexpr int kOutlinePixels = 8;
inline constexpr int kOutlineReach_px = 3;
/// Offset of the first block: blocks that cross the edge of a tile reach equally far on both sides.
inline constexpr int kOutlineFirst = -1;
/// The surroundings of eight pixels begin this far to their left, and have this size.
inline constexpr int kOutlineBefore_px = kOutlineReach_px - kOutlineFirst;
inline constexpr int kAround_px = kOutlinePixels + 2 * kOutlineBefore_px;
inline constexpr int kAroundRows = kOutlineBlock_px + 2 * kOutlineReach_px;
/// Half of the rows around a block are enough, with the outermost among them. Counted from its
/// first row.
inline constexpr std::array<int, 4> kOutlineRows = {-3, -1, 2, 4};

/// Colours closer than this [grey levels] decide nothing.
inline constexpr float kLeastContrast = 4;
/// Pictures are gamma-coded: a pixel half covered by a darker person looks brighter than the mean
/// of the two colours.
inline constexpr float kHalfCovered = 0.4f;

/// What lies around eight pixels of two rows.
struct OutlineSurroundings {
  ImageView<const Bgr> image;          ///< kAround_px × kAroundRows.
  ImageView<const float> alpha_shift;  ///< α − 1 of the same pixels.
  /// Pixels well inside the silhouette, and well outside: the word that holds the eight pixels in
  /// the first row. Words beside it are readable; `stride` words further on lies the row below.
  const BitWord *inside, *outside;
  std::ptrdiff_t stride;
  int pixel;  ///< Place of the first pixel in the word, a multiple of eight.
};

/// Decisions on eight pixels, the first in the lowest bit.
struct OutlineDecision {
  std::uint8_t told;     ///< The colours of the person and of the background differ enough.
  std::uint8_t covered;  ///< The person covers half of the pixel.
};

/// Decides about eight pixels of two rows. The person's colour is the mean of the pixels inside,
/// and the background's brightness that of the pixels outside.
/// @param expected  the groups that hold the eight pixels, from pixel `first` on, for both rows.
std::array<OutlineDecision, kOutlineBlock_px> JudgeOutline(
    const OutlineSurroundings& around, const std::array<float, 3>& gain,
    const std::array<const WeighedPixels*, kOutlineBlock_px>& expected, int first);

}  // namespace mocap::kernels
