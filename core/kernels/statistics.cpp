#include "core/kernels/statistics.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/statistics.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

// Quantile of non-negative values, two bits at a time: their bits sort them as integers do.
float FindNumberAtRank(const float* values, int count, int rank) {
  std::uint32_t result = 0;
  for (int bits = 30; bits >= 0; bits -= 2) {
    const std::uint32_t one = result | 1u << bits, two = result | 2u << bits, three = one | two;
    int less_than_one = 0, less_than_two = 0, less_than_three = 0;
    for (int i = 0; i < count; ++i) {
      const auto value = std::bit_cast<std::uint32_t>(values[i]);
      less_than_one += value < one;
      less_than_two += value < two;
      less_than_three += value < three;
    }
    result = less_than_three <= rank ? three
             : less_than_two <= rank ? two
             : less_than_one <= rank ? one
                                     : result;
  }
  return std::bit_cast<float>(result);
}

void TakeAllLesser(const float* values, std::size_t count, float* least) {
  for (std::size_t i = 0; i < count; ++i) least[i] = std::min(least[i], values[i]);
}

void FindAllBins(const float* values, int count, float bins_per_unit, int bin_count, int* bins) {
  const float last = static_cast<float>(bin_count) - 1;
  for (int i = 0; i < count; ++i)
    bins[i] = static_cast<int>(std::min(std::max(values[i] * bins_per_unit, 0.0f), last));
}

// A displacement explains differences up to this [grey levels] plus this many gradients.
constexpr int kExplained = 4;
constexpr int kExplainedGradients = 1;

void AddGradientsOfRow(const std::uint8_t* live, const std::uint8_t* expected,
                       const float* variance, int stride, int gain, float unknown, int count,
                       GradientSums& sums) {
  int xx = 0, xy = 0, yy = 0, xd = 0, yd = 0;
  for (int i = 0; i < count; ++i) {
    const int gx = expected[i + 1] - expected[i - 1];
    // Rows lie apart, so the ones after the next count too: the error is of fourth order.
    const int gy = (8 * (expected[i + stride] - expected[i - stride]) -
                    (expected[i + 2 * stride] - expected[i - 2 * stride])) /
                   6;
    const int d = ((gain * live[i] + (1 << (kGainBits - 1))) >> kGainBits) - expected[i];
    const int steep = std::abs(gx) + std::abs(gy);
    const int counts = (std::abs(d) <= kExplained + kExplainedGradients * steep ? 1 : 0) &
                       (variance[i] < unknown ? 1 : 0);
    xx += counts * gx * gx;
    xy += counts * gx * gy;
    yy += counts * gy * gy;
    xd += counts * gx * d;
    yd += counts * gy * d;
  }
  sums.xx += xx, sums.xy += xy, sums.yy += yy, sums.xd += xd, sums.yd += yd;
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(FindNumberAtRank);
float NumberAtRank(const float* values, int count, int rank) {
  return HWY_DYNAMIC_DISPATCH(FindNumberAtRank)(values, count, rank);
}

HWY_EXPORT(TakeAllLesser);
void TakeLesser(const float* values, std::size_t count, float* least) {
  HWY_DYNAMIC_DISPATCH(TakeAllLesser)(values, count, least);
}

HWY_EXPORT(FindAllBins);
void FindBins(const float* values, int count, float bins_per_unit, int bin_count, int* bins) {
  HWY_DYNAMIC_DISPATCH(FindAllBins)(values, count, bins_per_unit, bin_count, bins);
}

HWY_EXPORT(AddGradientsOfRow);
void AddGradients(const std::uint8_t* live, const std::uint8_t* expected, const float* variance,
                  int stride, int gain, float unknown, int count, GradientSums& sums) {
  HWY_DYNAMIC_DISPATCH(AddGradientsOfRow)
  (live, expected, variance, stride, gain, unknown, count, sums);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
