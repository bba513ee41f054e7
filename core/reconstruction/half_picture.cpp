#include "core/reconstruction/half_picture.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

int RoundUp(int value, int step) { return (value + step - 1) / step * step; }

MOCAP_VECTORIZED
void AddRows(const std::uint8_t* a, const std::uint8_t* b, int count, std::uint16_t* sum) {
  for (int i = 0; i < count; ++i) sum[i] = static_cast<std::uint16_t>(a[i] + b[i]);
}

MOCAP_VECTORIZED
void JoinColumns(const std::uint16_t* sum, int count, std::uint8_t* b, std::uint8_t* g,
                 std::uint8_t* r) {
  for (int i = 0; i < count; ++i) {
    b[i] = static_cast<std::uint8_t>((sum[6 * i] + sum[6 * i + 3] + 2) >> 2);
    g[i] = static_cast<std::uint8_t>((sum[6 * i + 1] + sum[6 * i + 4] + 2) >> 2);
    r[i] = static_cast<std::uint8_t>((sum[6 * i + 2] + sum[6 * i + 5] + 2) >> 2);
  }
}

}  // namespace

HalfPicture::HalfPicture(int full_width, int full_height)
    : width(RoundUp(full_width, kTile_px) / 2), height(RoundUp(full_height, kTile_px) / 2) {
  for (auto& plane : color) plane.resize(size());
}

ExpectedHalf::ExpectedHalf(int full_width, int full_height)
    : mean(full_width, full_height), variance(mean.size(), kUnknownVariance), slope(mean.size()) {}

void ExpectedHalf::LearnFrom(ImageView<const Bgr> picture) {
  std::vector<std::uint16_t> scratch;
  Halve(picture, mean, scratch);
  // The padding continues the picture: its edge is no contour.
  std::vector<float> brightness(mean.size());
  for (int y = 0; y < mean.height; ++y) {
    for (int x = 0; x < mean.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(std::min(y, picture.height() / 2 - 1)) * mean.width +
          std::min(x, picture.width() / 2 - 1);
      brightness[static_cast<std::size_t>(y) * mean.width + x] =
          static_cast<float>(mean.color[0][i] + mean.color[1][i] + mean.color[2][i]) / 3;
    }
  }
  slope = SlopeOf(brightness, mean.width, mean.height);
}

void Halve(ImageView<const Bgr> image, HalfPicture& half, std::vector<std::uint16_t>& scratch) {
  const int columns = image.width() / 2;
  const int rows = image.height() / 2;
  MOCAP_CHECK(RoundUp(image.width(), HalfPicture::kTile_px) == 2 * half.width &&
              RoundUp(image.height(), HalfPicture::kTile_px) == 2 * half.height);
  scratch.resize(static_cast<std::size_t>(6) * columns);
  for (int y = 0; y < rows; ++y) {
    AddRows(&image(0, 2 * y).b, &image(0, 2 * y + 1).b, 6 * columns, scratch.data());
    const std::size_t begin = static_cast<std::size_t>(y) * half.width;
    JoinColumns(scratch.data(), columns, half.color[0].data() + begin, half.color[1].data() + begin,
                half.color[2].data() + begin);
  }
}

std::vector<std::uint8_t> SlopeOf(const std::vector<float>& brightness, int width, int height) {
  std::vector<std::uint8_t> slope(brightness.size());
  const auto at = [&](int x, int y) {
    return brightness[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width +
                      std::clamp(x, 0, width - 1)];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float here = at(x, y);
      const float dx = std::max(std::abs(at(x + 1, y) - here), std::abs(at(x - 1, y) - here));
      const float dy = std::max(std::abs(at(x, y + 1) - here), std::abs(at(x, y - 1) - here));
      slope[static_cast<std::size_t>(y) * width + x] =
          static_cast<std::uint8_t>(std::min(std::hypot(dx, dy), 255.0f));
    }
  }
  return slope;
}

}  // namespace mocap
