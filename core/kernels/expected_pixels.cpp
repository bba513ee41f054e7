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

void AddDistortionsOf(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                      const PixelStatistics& expected, float* alpha_shift_sq, float* cd_sq) {
  const float g0 = gain[0], g1 = gain[1], g2 = gain[2];
  const auto [e0, e1, e2] = expected.mean;
  const auto [v0, v1, v2] = expected.variance;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float s0 = std::sqrt(v0[x]), s1 = std::sqrt(v1[x]), s2 = std::sqrt(v2[x]);
    const float z0 = pixels[x].b * g0 / s0, z1 = pixels[x].g * g1 / s1, z2 = pixels[x].r * g2 / s2;
    const float m0 = e0[x] / s0, m1 = e1[x] / s1, m2 = e2[x] / s2;
    const float along = z0 * m0 + z1 * m1 + z2 * m2;
    const float length_sq = m0 * m0 + m1 * m1 + m2 * m2;
    const float total_sq = (z0 - m0) * (z0 - m0) + (z1 - m1) * (z1 - m1) + (z2 - m2) * (z2 - m2);
    const float shift = along / length_sq - 1;
    const float distance_sq = total_sq - shift * shift * length_sq;
    // After a picture is subtracted again, rounding must not leave negative sums.
    alpha_shift_sq[x] = std::max(alpha_shift_sq[x] + times * shift * shift, 0.0f);
    cd_sq[x] = std::max(cd_sq[x] + times * std::max(distance_sq, 0.0f), 0.0f);
  }
}

void ExpectAll(const PixelSums& sums, int count, float frames, float shift_px,
               const LearnedPixels& to) {
  const std::uint8_t* const slope = to.slope;
  for (int c = 0; c < 3; ++c) {
    const float *const value = sums.value[c], *const value_sq = sums.value_sq[c];
    const float* const cd_sq = sums.cd_sq;
    float *const mean = to.mean[c], *const variance = to.variance[c];
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
      const float middle = value[x] / frames;
      const float spread = (value_sq[x] / frames - middle * middle) * frames / (frames - 1);
      // If only σ acts, the variation of the chromaticity distortion is √2.
      const float widening = std::max(std::sqrt(cd_sq[x] / frames / 2), 1.0f);
      const float sigma = std::max(std::sqrt(std::max(spread, 0.0f)), kLeastSigma) * widening;
      // The error of a σ that was learned from few frames shows at contours.
      const float shift = shift_px * static_cast<float>(slope[x]);
      mean[x] = std::max(middle, kDarkestMean);
      variance[x] = sigma * sigma + shift * shift;
    }
  }
  const float* const alpha_shift_sq = sums.alpha_shift_sq;
  float* const alpha_limit = to.alpha_limit;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    alpha_limit[x] = 1 / std::max(std::sqrt(alpha_shift_sq[x] / frames), 1e-6f);
}

constexpr int kPixels = WeighedPixels::kPixels;

HWY_INLINE std::uint16_t Rounded(float value) {
  return static_cast<std::uint16_t>(static_cast<int>(std::min(value, 65535.0f) + 0.5f));
}

void WeighGroups(const WeighedFrom& from, int groups, float shift_sq, WeighedPixels* to,
                 int stride) {
  const auto [e0, e1, e2] = from.mean;
  const auto [v0, v1, v2] = from.variance;
  const float* const alpha_limit = from.alpha_limit;
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
      const float alpha_weight = std::min(std::sqrt(square), alpha_limit[x]);
      group.mean[0][k] = Rounded(e0[x] / WeighedPixels::kMeanUnit);
      group.mean[1][k] = Rounded(e1[x] / WeighedPixels::kMeanUnit);
      group.mean[2][k] = Rounded(e2[x] / WeighedPixels::kMeanUnit);
      group.inverse_sigma[0][k] = Rounded(std::sqrt(i0) / WeighedPixels::kInverseSigmaUnit);
      group.inverse_sigma[1][k] = Rounded(std::sqrt(i1) / WeighedPixels::kInverseSigmaUnit);
      group.inverse_sigma[2][k] = Rounded(std::sqrt(i2) / WeighedPixels::kInverseSigmaUnit);
      group.alpha_weight[k] = Rounded(alpha_weight / WeighedPixels::kAlphaWeightUnit);
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

HWY_EXPORT(AddDistortionsOf);
void AddDistortions(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                    const PixelStatistics& expected, float* alpha_shift_sq, float* cd_sq) {
  HWY_DYNAMIC_DISPATCH(AddDistortionsOf)
  (pixels, count, gain, times, expected, alpha_shift_sq, cd_sq);
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
