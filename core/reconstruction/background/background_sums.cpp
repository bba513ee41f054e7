#include "core/reconstruction/background/background_sums.h"

#include <algorithm>

#include "core/kernels/expected_pixels.h"

namespace mocap {
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
    kernels::AddValues(channels[c], count, gain[c], times, &value_[c][begin], &value_sq_[c][begin]);
}

void BackgroundSums::AddDistortions(const Bgr* pixels, int count, const std::array<float, 3>& gain,
                                    float times, const ExpectedPicture& expected,
                                    std::size_t expected_begin, std::size_t begin) {
  kernels::PixelStatistics from;
  for (int c = 0; c < 3; ++c) {
    from.mean[c] = &expected.mean[c][expected_begin];
    from.variance[c] = &expected.variance[c][expected_begin];
  }
  kernels::AddDistortions(pixels, count, gain, times, from, &alpha_shift_sq_[begin],
                          &cd_sq_[begin]);
}

void BackgroundSums::Expect(std::size_t begin, int count, float frames, float shift_px,
                            std::size_t to_begin, ExpectedPicture& to) const {
  kernels::PixelSums sums{{}, {}, &alpha_shift_sq_[begin], &cd_sq_[begin]};
  kernels::LearnedPixels learned{{}, {}, &to.alpha_limit[to_begin], &to.slope[to_begin]};
  for (int c = 0; c < 3; ++c) {
    sums.value[c] = &value_[c][begin];
    sums.value_sq[c] = &value_sq_[c][begin];
    learned.mean[c] = &to.mean[c][to_begin];
    learned.variance[c] = &to.variance[c][to_begin];
  }
  kernels::ExpectPixels(sums, count, frames, shift_px, learned);
}

}  // namespace mocap
