// Statistics of rows of numbers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mocap::kernels {

/// Finds the number at a rank, counted from 0, among non-negative ones.
float NumberAtRank(const float* values, int count, int rank);

/// Replaces numbers by lesser ones.
void TakeLesser(const float* values, std::size_t count, float* least);

/// Finds the bins of a histogram that numbers fall into; the outermost bins get what lies beyond.
void FindBins(const float* values, int count, float bins_per_unit, int bin_count, int* bins);

/// Normal equations of a displacement: products of gradients with each other and with differences.
struct GradientSums {
  std::int64_t xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
};
/// Bits of a fixed-point gain behind the point.
inline constexpr int kGainBits = 8;

/// Adds a row of pixels. Gradients are doubled. Differences that no displacement explains do not
/// count, and neither do pixels with a variance of `unknown` or more.
/// @param stride  from the row of `expected` to the next; two rows above and below are readable,
///                and one pixel beside.
void AddGradients(const std::uint8_t* live, const std::uint8_t* expected, const float* variance,
                  int stride, int gain, float unknown, int count, GradientSums& sums);

}  // namespace mocap::kernels
