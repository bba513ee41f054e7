// What outline.h means, pixel by pixel.
#pragma once

#include "core/kernels/outline.h"

namespace mocap::kernels::reference {

/// Whether a pixel of the surroundings is set. Coordinates count from the eight pixels' first.
inline bool IsSet(const BitWord* plane, const OutlineSurroundings& around, int x, int y) {
  const int bit = around.pixel + x;
  const BitWord* const word = plane + y * around.stride + (bit >> 6);
  return (*word >> (bit & 63) & 1) != 0;
}

/// The person's colour and the background's brightness around a block. NaN if there are none, so
/// that nothing is decided.
struct BlockSurroundings {
  std::array<float, 3> person;
  float alpha;
};
/// @param left  first column of the surroundings.
inline BlockSurroundings LookAround(const OutlineSurroundings& around, int left,
                                    const std::array<float, 3>& gain) {
  std::array<int, 3> colors{};
  int inside = 0, outside = 0;
  std::array<float, kOutlineReach_px * 2 + kOutlineBlock_px> shifts{};
  for (const int row : kOutlineRows) {
    for (std::size_t column = 0; column < shifts.size(); ++column) {
      const int x = left + static_cast<int>(column);
      if (IsSet(around.inside, around, x - kOutlineBefore_px, row)) {
        const Bgr& pixel = around.image(x, kOutlineReach_px + row);
        colors[0] += pixel.b, colors[1] += pixel.g, colors[2] += pixel.r;
        ++inside;
      }
      if (IsSet(around.outside, around, x - kOutlineBefore_px, row)) {
        shifts[column] += around.alpha_shift(x, kOutlineReach_px + row);
        ++outside;
      }
    }
  }
  const float shift = ((shifts[0] + shifts[1]) + (shifts[2] + shifts[3])) +
                      ((shifts[4] + shifts[5]) + (shifts[6] + shifts[7]));
  const float per_pixel = 1 / static_cast<float>(inside);
  BlockSurroundings result;
  for (int c = 0; c < 3; ++c)
    result.person[c] = per_pixel * static_cast<float>(colors[c]) * gain[c];
  result.alpha = 1 + shift / static_cast<float>(outside);
  return result;
}

inline std::array<OutlineDecision, kOutlineBlock_px> JudgeOutline(
    const OutlineSurroundings& around, const std::array<float, 3>& gain,
    const std::array<const WeighedPixels*, kOutlineBlock_px>& expected, int first) {
  std::array<OutlineDecision, kOutlineBlock_px> decisions{};
  for (int row = 0; row < kOutlineBlock_px; ++row) {
    for (int x = 0; x < kOutlinePixels; ++x) {
      const BlockSurroundings block = LookAround(around, (x - kOutlineFirst) / 2 * 2, gain);
      const Bgr& pixel = around.image(kOutlineBefore_px + x, kOutlineReach_px + row);
      const std::array<std::uint8_t, 3> live = {pixel.b, pixel.g, pixel.r};
      float along = 0, contrast_sq = 0;
      for (int c = 0; c < 3; ++c) {
        const float background =
            expected[row]->mean[c][first + x] * WeighedPixels::kMeanUnit * block.alpha;
        const float contrast = block.person[c] - background;
        along += contrast * (live[c] * gain[c] - background);
        contrast_sq += contrast * contrast;
      }
      const auto bit = static_cast<std::uint8_t>(1 << x);
      if (contrast_sq >= kLeastContrast * kLeastContrast) decisions[row].told |= bit;
      if (along > kHalfCovered * contrast_sq) decisions[row].covered |= bit;
    }
  }
  return decisions;
}

}  // namespace mocap::kernels::reference
