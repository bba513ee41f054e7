#include "core/kernels/expected_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/kernels/expected_pixels.cpp"
#include "core/kernels/each_target.h"

HWY_BEFORE_NAMESPACE();
namespace mocap::kernels::HWY_NAMESPACE {
namespace {

// Below this [grey levels] variation comes from rounding and the codec, not from the sensor.
constexpr float kLeastSigma = 1.5f;

void AddChannel(const std::uint8_t* values, int count, float gain, float times, float* sum,
                float* sum_sq) {
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float value = values[3 * x] * gain;
    sum[x] += times * value;
    sum_sq[x] += times * value * value;
  }
}

void ExpectAll(const PixelSums& sums, int count, float frames, float shift_px,
               const LearnedPixels& to) {
  const std::uint8_t* const slope = to.slope;
  for (int c = 0; c < 3; ++c) {
    const float *const value = sums.value[c], *const value_sq = sums.value_sq[c];
    float *const mean = to.mean[c], *const variance = to.variance[c];
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
      const float middle = value[x] / frames;
      const float spread = (value_sq[x] / frames - middle * middle) * frames / (frames - 1);
      // The error of a σ that was learned from few frames shows at contours.
      const float shift = shift_px * static_cast<float>(slope[x]);
      mean[x] = std::max(middle, kDarkestMean);
      variance[x] = std::max(spread, kLeastSigma * kLeastSigma) + shift * shift;
    }
  }
}

constexpr int kPixels = WeighedPixels::kPixels;

HWY_INLINE std::uint16_t Rounded(float value) {
  return static_cast<std::uint16_t>(static_cast<int>(std::min(value, 65535.0f) + 0.5f));
}

void WeighGroups(const WeighedFrom& from, int groups, float shift_sq, WeighedPixels* to,
                 int stride) {
  const auto [e0, e1, e2] = from.mean;
  const auto [v0, v1, v2] = from.variance;
  const std::uint8_t* const slopes = from.slope;
  for (int g = 0; g < groups; ++g) {
    WeighedPixels& group = to[static_cast<std::ptrdiff_t>(g) * stride];
    const int first = g * kPixels;
#pragma GCC ivdep
    for (int k = 0; k < kPixels; ++k) {
      const int x = first + k;
      const float slope = slopes[x];
      const float more = shift_sq * slope * slope;
      const float i0 = 1 / (v0[x] + more), i1 = 1 / (v1[x] + more), i2 = 1 / (v2[x] + more);
      const float square = e0[x] * e0[x] * i0 + e1[x] * e1[x] * i1 + e2[x] * e2[x] * i2;
      group.mean[0][k] = Rounded(e0[x] / WeighedPixels::kMeanUnit);
      group.mean[1][k] = Rounded(e1[x] / WeighedPixels::kMeanUnit);
      group.mean[2][k] = Rounded(e2[x] / WeighedPixels::kMeanUnit);
      group.inverse_sigma[0][k] = Rounded(std::sqrt(i0) / WeighedPixels::kInverseSigmaUnit);
      group.inverse_sigma[1][k] = Rounded(std::sqrt(i1) / WeighedPixels::kInverseSigmaUnit);
      group.inverse_sigma[2][k] = Rounded(std::sqrt(i2) / WeighedPixels::kInverseSigmaUnit);
      group.alpha_weight[k] = Rounded(std::sqrt(square) / WeighedPixels::kAlphaWeightUnit);
    }
  }
}

void FinishAll(const std::uint8_t* is_known, int count, float variance, float unknown, float* mean,
               float* variances) {
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    mean[x] = is_known[x] ? std::max(mean[x], kDarkestMean) : 255;
    variances[x] = is_known[x] ? variance : unknown;
  }
}

}  // namespace
}  // namespace mocap::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mocap::kernels {

HWY_EXPORT(AddChannel);
void AddValues(const std::uint8_t* values, int count, float gain, float times, float* sum,
               float* sum_sq) {
  HWY_DYNAMIC_DISPATCH(AddChannel)(values, count, gain, times, sum, sum_sq);
}

HWY_EXPORT(ExpectAll);
void ExpectPixels(const PixelSums& sums, int count, float frames, float shift_px,
                  const LearnedPixels& to) {
  HWY_DYNAMIC_DISPATCH(ExpectAll)(sums, count, frames, shift_px, to);
}

HWY_EXPORT(WeighGroups);
void WeighPixels(const WeighedFrom& from, int groups, float shift_sq, WeighedPixels* to,
                 int stride) {
  HWY_DYNAMIC_DISPATCH(WeighGroups)(from, groups, shift_sq, to, stride);
}

HWY_EXPORT(FinishAll);
void FinishDrawn(const std::uint8_t* is_known, int count, float variance, float unknown,
                 float* mean, float* variances) {
  HWY_DYNAMIC_DISPATCH(FinishAll)(is_known, count, variance, unknown, mean, variances);
}

}  // namespace mocap::kernels
#endif  // HWY_ONCE
