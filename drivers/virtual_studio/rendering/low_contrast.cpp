#include "drivers/virtual_studio/rendering/low_contrast.h"

#include <algorithm>
#include <vector>

namespace mocap::simulation {
namespace {

// The smoothing reaches this part of the picture's width to either side.
constexpr int kSmoothingShare = 40;
// Upright surfaces have these shades, so that clothes are as often darker as lighter.
constexpr float kMiddleShade = 0.56f, kShadeReach = 0.16f;

// Means of `reach` values to either side, fewer at the ends.
template <typename Light>
void Smooth(const std::vector<Light>& line, int reach, std::vector<Light>& means) {
  const int count = static_cast<int>(line.size());
  Light sum;
  int begin = 0, end = 0;
  for (int i = 0; i < count; ++i) {
    for (; end < std::min(count, i + reach + 1); ++end)
      sum = {sum.b + line[end].b, sum.g + line[end].g, sum.r + line[end].r};
    for (; begin < i - reach; ++begin)
      sum = {sum.b - line[begin].b, sum.g - line[begin].g, sum.r - line[begin].r};
    const float share = 1 / static_cast<float>(end - begin);
    means[i] = {sum.b * share, sum.g * share, sum.r * share};
  }
}

}  // namespace

void LowContrast::SetView(const Image<Bgr>& empty) {
  const int width = empty.width(), height = empty.height();
  const int reach = std::max(1, width / kSmoothingShare);
  smooth_ = Image<Light>(width, height);
  std::vector<Light> line(width), means(width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Bgr pixel = empty(x, y);
      line[x] = {float(pixel.b), float(pixel.g), float(pixel.r)};
    }
    Smooth(line, reach, means);
    std::ranges::copy(means, smooth_.row(y));
  }
  line.resize(height), means.resize(height);
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) line[y] = smooth_(x, y);
    Smooth(line, reach, means);
    for (int y = 0; y < height; ++y) smooth_(x, y) = means[y];
  }
}

Bgr LowContrast::ColorAt(int x, int y, Bgr empty, float shade) const {
  const float off = grey_values_ * std::clamp((shade - kMiddleShade) / kShadeReach, -1.0f, 1.0f);
  const auto value = [&](float smooth, std::uint8_t behind) {
    const float low = float(behind) - grey_values_, high = float(behind) + grey_values_;
    return static_cast<std::uint8_t>(
        std::clamp(std::clamp(smooth + off, low, high) + 0.5f, 0.0f, 255.0f));
  };
  const Light& smooth = smooth_(x, y);
  return {value(smooth.b, empty.b), value(smooth.g, empty.g), value(smooth.r, empty.r)};
}

}  // namespace mocap::simulation
