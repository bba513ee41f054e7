#include "core/reconstruction/background/background_sums.h"

#include <algorithm>
#include <cmath>

#include "core/vectorized.h"

namespace mocap {
namespace {

// Below this [grey levels] variation comes from rounding and the codec, not from the sensor.
constexpr float kLeastSigma = 1.5f;

MOCAP_VECTORIZED
void AddChannel(const std::uint8_t* values, int count, float gain, float times, float* sum,
                float* sum_sq) {
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float value = values[3 * x] * gain;
    sum[x] += times * value;
    sum_sq[x] += times * value * value;
  }
}

struct Expected {
  std::array<const float*, 3> mean, variance;
};

MOCAP_VECTORIZED
void AddDistortionsOf(const Bgr* pixels, int count, const std::array<float, 3>& gain, float times,
                      const Expected& expected, float* alpha_shift_sq, float* cd_sq) {
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

struct SumsOf {
  std::array<const float*, 3> value, value_sq;
  const float *alpha_shift_sq, *cd_sq;
};
struct Learned {
  std::array<float*, 3> mean, variance;
  float* alpha_limit;
  const std::uint8_t* slope;
};

MOCAP_VECTORIZED
void ExpectPixels(const SumsOf& sums, int count, float frames, float shift_px, const Learned& to) {
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
      mean[x] = std::max(middle, ExpectedPicture::kDarkestMean);
      variance[x] = sigma * sigma + shift * shift;
    }
  }
  const float* const alpha_shift_sq = sums.alpha_shift_sq;
  float* const alpha_limit = to.alpha_limit;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    alpha_limit[x] = 1 / std::max(std::sqrt(alpha_shift_sq[x] / frames), 1e-6f);
}

}  // namespace

BackgroundSums::BackgroundSums(std::size_t pixels) : alpha_shift_sq_(pixels), cd_sq_(pixels) {
  for (auto* planes : {&value_, &value_sq_})
    for (auto& plane : *planes) plane.resize(pixels);
}

void BackgroundSums::Clear(std::size_t begin, std::size_t count) {
  for (auto* planes : {&value_, &value_sq_})
    for (auto& plane : *planes) std::fill_n(&plane[begin], count, 0.0f);
  for (auto* plane : {&alpha_shift_sq_, &cd_sq_}) std::fill_n(&(*plane)[begin], count, 0.0f);
}

void BackgroundSums::Copy(const BackgroundSums& from, std::size_t begin, std::size_t count) {
  for (int c = 0; c < 3; ++c) {
    std::copy_n(&from.value_[c][begin], count, value_[c].data());
    std::copy_n(&from.value_sq_[c][begin], count, value_sq_[c].data());
  }
  std::copy_n(&from.alpha_shift_sq_[begin], count, alpha_shift_sq_.data());
  std::copy_n(&from.cd_sq_[begin], count, cd_sq_.data());
}

void BackgroundSums::AddColors(const Bgr* pixels, int count, const std::array<float, 3>& gain,
                               float times, std::size_t begin) {
  const std::array<const std::uint8_t*, 3> channels = {&pixels->b, &pixels->g, &pixels->r};
  for (int c = 0; c < 3; ++c)
    AddChannel(channels[c], count, gain[c], times, &value_[c][begin], &value_sq_[c][begin]);
}

void BackgroundSums::AddDistortions(const Bgr* pixels, int count, const std::array<float, 3>& gain,
                                    float times, const ExpectedPicture& expected,
                                    std::size_t expected_begin, std::size_t begin) {
  Expected from;
  for (int c = 0; c < 3; ++c) {
    from.mean[c] = &expected.mean[c][expected_begin];
    from.variance[c] = &expected.variance[c][expected_begin];
  }
  AddDistortionsOf(pixels, count, gain, times, from, &alpha_shift_sq_[begin], &cd_sq_[begin]);
}

void BackgroundSums::Expect(std::size_t begin, int count, float frames, float shift_px,
                            std::size_t to_begin, ExpectedPicture& to) const {
  SumsOf sums{{}, {}, &alpha_shift_sq_[begin], &cd_sq_[begin]};
  Learned learned{{}, {}, &to.alpha_limit[to_begin], &to.slope[to_begin]};
  for (int c = 0; c < 3; ++c) {
    sums.value[c] = &value_[c][begin];
    sums.value_sq[c] = &value_sq_[c][begin];
    learned.mean[c] = &to.mean[c][to_begin];
    learned.variance[c] = &to.variance[c][to_begin];
  }
  ExpectPixels(sums, count, frames, shift_px, learned);
}

}  // namespace mocap
