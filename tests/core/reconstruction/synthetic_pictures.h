// Pictures of an empty studio with noise, and things to put into them.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A picture in exact values [grey levels], before the sensor's noise.
using ExactPicture = Image<std::array<float, 3>>;

/// A grey wall, uneven and slightly tinted, above a darker floor.
ExactPicture EmptyStudio(int width, int height);

/// What a camera delivers: normal noise of `sigma` grey levels, rounded.
class NoisySensor {
 public:
  NoisySensor(float sigma, unsigned seed) : noise_(0, sigma), random_(seed) {}
  Image<Bgr> Take(const ExactPicture& picture, float brightness = 1);

 private:
  std::normal_distribution<float> noise_;
  std::mt19937 random_;
};

std::vector<BackgroundFrame> TakeBackground(const ExactPicture& picture, int count,
                                            NoisySensor& sensor);

inline int CountSet(const Silhouette& s, const PixelBox& box) {
  int count = 0;
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.left; x <= box.right; ++x) count += s.Test(x, y);
  return count;
}

inline int CountSet(const Silhouette& s) {
  return CountSet(s, {0, 0, s.width() - 1, s.height() - 1});
}

/// Multiplies a rectangle by a factor.
void Dim(ExactPicture& picture, const PixelBox& box, float factor);

/// Paints a rectangle.
void Paint(ExactPicture& picture, const PixelBox& box, const std::array<float, 3>& color);

}  // namespace mocap
