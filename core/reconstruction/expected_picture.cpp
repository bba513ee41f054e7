#include "core/reconstruction/expected_picture.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

// A colour has a direction only away from black.
constexpr float kDarkestMean = 1;
constexpr int kGainStep_px = 5;
constexpr float kLargestGain = 4;
// What differs more from the middle than by this share is no background.
constexpr float kFlatness = 0.06f;
// Pixels whose brightness may vary by more than itself are not known.
constexpr float kLeastKnown = 1;

float Median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

ExpectedPicture::ExpectedPicture(int picture_width, int picture_height)
    : width(picture_width), height(picture_height) {
  const std::size_t size = static_cast<std::size_t>(width) * height;
  for (auto& plane : scaled_mean) plane.resize(size);
  for (auto& plane : inverse_sigma) plane.resize(size);
  inverse_alpha_variation.resize(size);
}

void ExpectedPicture::SetPixel(std::size_t i, const std::array<float, 3>& mean,
                               const std::array<float, 3>& sigma, float alpha_variation) {
  float length_sq = 0;
  for (int c = 0; c < 3; ++c) {
    inverse_sigma[c][i] = 1 / sigma[c];
    scaled_mean[c][i] = std::max(mean[c], kDarkestMean) / sigma[c];
    length_sq += scaled_mean[c][i] * scaled_mean[c][i];
  }
  inverse_alpha_variation[i] = std::min(std::sqrt(length_sq), 1 / std::max(alpha_variation, 1e-6f));
}

float MeasureGain(const ExpectedPicture& expected, ImageView<const Bgr> image,
                  std::vector<float>& scratch) {
  MOCAP_CHECK(image.width() == expected.width && image.height() == expected.height);
  scratch.clear();
  for (int y = kGainStep_px / 2; y < expected.height; y += kGainStep_px) {
    for (int x = kGainStep_px / 2; x < expected.width; x += kGainStep_px) {
      const std::size_t i = static_cast<std::size_t>(y) * expected.width + x;
      if (expected.inverse_alpha_variation[i] < kLeastKnown) continue;
      const Bgr& p = image(x, y);
      const float color[3] = {static_cast<float>(p.b), static_cast<float>(p.g),
                              static_cast<float>(p.r)};
      float along = 0, length_sq = 0;
      for (int c = 0; c < 3; ++c) {
        const float m = expected.scaled_mean[c][i];
        along += color[c] * expected.inverse_sigma[c][i] * m;
        length_sq += m * m;
      }
      scratch.push_back(along / length_sq);
    }
  }
  if (scratch.empty()) return 1;
  // Persons and shadows lie mostly to one side of the middle; without them it is found again.
  const float rough = Median(scratch);
  std::erase_if(scratch, [rough](float v) { return std::abs(v - rough) > kFlatness * rough; });
  const float fine = scratch.empty() ? rough : Median(scratch);
  return std::clamp(1 / std::max(fine, 1e-3f), 1 / kLargestGain, kLargestGain);
}

}  // namespace mocap
