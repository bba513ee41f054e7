// §4: distortions of square windows around pixels, in two sizes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mocap::kernels {

/// Half the side of each window, without the pixel in the middle.
inline constexpr std::array<int, 2> kWindowRadii_px = {2, 3};
inline constexpr std::size_t kWindows = kWindowRadii_px.size();
inline constexpr int kLargestRadius_px = kWindowRadii_px.back();

/// Pixels are summed and judged in blocks of this many of a row.
inline constexpr int kBlock_px = 8;

/// For a block: sums along its line over the width of a window around each pixel.
struct alignas(32) LineSums {
  using Column = std::array<float, kBlock_px>;
  Column alpha, alpha_sq;  ///< α − 1 and its square.
  Column moment;           ///< α − 1 times the distance to the right.
  std::array<Column, 3> cd;
};

/// For all windows around the pixels of a block.
using BlockSums = std::array<LineSums, kWindows>;
/// Number of lines in the windows around two pixels, one below the other.
inline constexpr int kPairLines = 2 * kLargestRadius_px + 2;
/// Number of lines of the same block that are stored together. Lines come a few at a time, some of
/// them before they are needed.
inline constexpr int kSumLines = kPairLines + 4;

/// Sums over the widths of all windows, in some lines of adjacent blocks.
/// @param alpha_shift, cd  first pixel of the first line, in lines `row_step` numbers apart. The
///                         largest radius on both sides is readable.
/// @param sums             the first line in the first block.
void SumAlongLines(const float* alpha_shift, const std::array<const float*, 3>& cd, int row_step,
                   int blocks, int rows, BlockSums* sums);

/// One row of measured pixels. Each pointer has one value per pixel.
struct DistortionRow {
  const float* alpha_shift = nullptr;    ///< α − 1.
  const float* cd_sq = nullptr;          ///< CD².
  const float* alpha_weight = nullptr;   ///< 1/a: (α − 1)/a is normalised.
  const float* inverse_sigma = nullptr;  ///< 1/σ of green.
};

/// The sums of the first blocks of two adjacent rows, and of the lines above and below that their
/// windows may need. Those of further blocks follow in steps of kSumLines.
using WindowLines = std::array<const BlockSums*, kPairLines>;

/// Two adjacent rows.
struct DistortionRowPair {
  std::array<DistortionRow, 2> rows;
  WindowLines sums{};
};

/// Limits of darkness, absolute and in units of the background's variation.
struct DarknessLimits {
  float shift;       ///< Of α − 1.
  float normalized;  ///< Of (α − 1)/a.
};

/// What a pixel, or a window, must exceed to be no background.
struct PixelLimits {
  DarknessLimits dark;
  float cd_sq;
};
struct WindowLimits {
  DarknessLimits dark;
  float per_cd, per_alpha, per_roughness;  ///< Squared thresholds, inverted.
  float margin_sq;  ///< Above the threshold is doubtful, above threshold times margin is clear.
};
struct DistortionLimits {
  PixelLimits pixel;
  std::array<WindowLimits, kWindows> windows;
  float drift;  ///< Allowed deviation of a whole window [grey levels].
};

/// Decisions on the pixels of a row, in bits. A byte holds those of a block.
struct DecisionBytes {
  std::uint8_t *clear_pixels, *dark;
  std::array<std::uint8_t*, kWindows> doubtful, clear;
};

/// Decides about the pixels [begin, end) of two rows, and about the windows around them.
/// @param begin  a multiple of kBlock_px.
/// @param rows   1 if only the first row counts.
void JudgeWindows(const DistortionRowPair& pair, int begin, int end, const DistortionLimits& limits,
                  const std::array<DecisionBytes, 2>& to, int rows);

/// Deviations of the windows of one size in a row, normalised. Whole blocks are written.
struct WindowRow {
  float* cd;         ///< Length of the mean colour distance.
  float* alpha;      ///< |α − 1|/a, of the mean.
  float* roughness;  ///< Standard deviation of α about a plane, divided by a.
};

/// Measures the windows of one size around the pixels of two rows.
/// @param window  index of the size.
void NormalizeWindows(const DistortionRowPair& pair, int blocks, std::size_t window,
                      const std::array<WindowRow, 2>& to);

/// Measures the distortions of single pixels of a row, normalised.
/// @param darker  how much darker than the background; negative if brighter.
void NormalizePixels(const DistortionRow& row, int count, float* cd, float* darker);

}  // namespace mocap::kernels
