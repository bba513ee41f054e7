#include "tests/core/reconstruction/synthetic_pictures.h"

#include <algorithm>
#include <cmath>

namespace mocap {

ExactPicture EmptyStudio(int width, int height) {
  ExactPicture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float fx = static_cast<float>(x), fy = static_cast<float>(y);
      float grey = 120 + 12 * std::sin(fx / 23) + 8 * std::cos(fy / 31 + fx / 57);
      if (3 * y > 2 * height) grey -= 30;
      picture(x, y) = {0.95f * grey, grey, 1.04f * grey};
    }
  }
  return picture;
}

Image<Bgr> NoisySensor::Take(const ExactPicture& picture, float brightness) {
  Image<Bgr> image(picture.width(), picture.height());
  const auto value = [&](float exact) {
    return static_cast<std::uint8_t>(
        std::clamp(std::round(exact * brightness + noise_(random_)), 0.0f, 255.0f));
  };
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const std::array<float, 3>& exact = picture.pixels()[i];
    image.pixels()[i] = {value(exact[0]), value(exact[1]), value(exact[2])};
  }
  return image;
}

std::vector<BackgroundFrame> TakeBackground(const ExactPicture& picture, int count,
                                            NoisySensor& sensor) {
  std::vector<BackgroundFrame> frames;
  for (int i = 0; i < count; ++i) frames.push_back({sensor.Take(picture), {}});
  return frames;
}

void Dim(ExactPicture& picture, const PixelBox& box, float factor) {
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x)
      for (float& value : picture(x, y)) value *= factor;
}

void Paint(ExactPicture& picture, const PixelBox& box, const std::array<float, 3>& color) {
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) picture(x, y) = color;
}

}  // namespace mocap
