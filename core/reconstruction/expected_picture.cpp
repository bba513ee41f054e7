#include "core/reconstruction/expected_picture.h"

#include <algorithm>

namespace mocap {

ExpectedPicture::ExpectedPicture(int picture_width, int picture_height)
    : width(picture_width), height(picture_height) {
  const std::size_t size = static_cast<std::size_t>(width) * height;
  for (auto& plane : mean) plane.resize(size);
  for (auto& plane : variance) plane.resize(size);
  alpha_weight.resize(size);
  slope.resize(size);
}

void ExpectedPicture::SetPixel(std::size_t i, const std::array<float, 3>& color,
                               const std::array<float, 3>& sigma, float alpha_variation) {
  for (int c = 0; c < 3; ++c) {
    mean[c][i] = std::max(color[c], kDarkestMean);
    variance[c][i] = sigma[c] * sigma[c];
  }
  alpha_weight[i] = 1 / std::max(alpha_variation, 1e-6f);
}

}  // namespace mocap
