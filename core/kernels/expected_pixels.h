// §4: learning the empty studio's pixels, row by row, in planes.
#pragma once

#include <array>
#include <cstdint>

#include "core/image.h"
#include "core/kernels/distortions.h"

namespace mocap::kernels {

/// Adds a channel of pixels to sums of its values and their squares.
/// @param values  every third byte.
/// @param times   how often the pixels count; negative to subtract them again.
void AddValues(const std::uint8_t* values, int count, float gain, float times, float* sum,
               float* sum_sq);

/// Sums over the frames of a recording.
struct PixelSums {
  std::array<const float*, 3> value, value_sq;
};
struct LearnedPixels {
  std::array<float*, 3> mean, variance;
  const std::uint8_t* slope;
};

/// Near black, a colour has no direction: means are at least this.
inline constexpr float kDarkestMean = 1;

/// Derives means and variances from sums.
/// @param shift_px  contours are expected to shift by this much.
void ExpectPixels(const PixelSums& sums, int count, float frames, float shift_px,
                  const LearnedPixels& to);

/// What pixels are weighed by.
struct WeighedFrom {
  std::array<const float*, 3> mean, variance;
  const std::uint8_t* slope;
};

/// Packs groups of pixels. The next group is written `stride` further on.
/// @param shift_sq  added to the variances, times the squared slope.
void WeighPixels(const WeighedFrom& from, int groups, float shift_sq, WeighedPixels* to,
                 int stride);

/// Sets the variance of drawn pixels, the same in all channels, and marks the others as unknown.
/// @param unknown  variance of these.
void FinishDrawn(const std::uint8_t* is_known, int count, float variance, float unknown,
                 float* mean, float* variances);

}  // namespace mocap::kernels
