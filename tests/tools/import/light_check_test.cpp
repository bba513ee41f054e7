// Exposure and white balance that are not fixed.
#include "tools/import/light_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mocap {
namespace {

/// A wall with a pattern and noise, and somebody who walks by.
Image<Bgr> Wall(double brightness, double red, int person_at, unsigned seed) {
  Image<Bgr> image(120, 90);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 2);
  const auto level = [&](double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value + noise(random)), 0L, 255L));
  };
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      const double wall = brightness * (90 + 40 * ((x / 15 + y / 15) % 2));
      image(x, y) = {level(wall), level(wall), level(wall * red)};
      if (std::abs(x - person_at) < 15 && y > 20) image(x, y) = {20, 30, 60};
    }
  }
  return image;
}

LightRange RangeOf(double brightness, double red) {
  LightMeter meter;
  for (unsigned i = 0; i < 6; ++i)
    meter.Add(Wall(i == 4 ? brightness : 1, i == 4 ? red : 1, static_cast<int>(20 * i), i).view());
  return meter.range();
}

TEST(LightMeter, DoesNotMindPeople) {
  EXPECT_NEAR(RangeOf(1, 1).BrightnessChange(), 0, 0.01);
  EXPECT_NEAR(RangeOf(1, 1).ColorChange(), 0, 0.01);
  EXPECT_TRUE(RangeOf(1, 1).IsExposureFixed());
}

TEST(LightMeter, FindsAnotherExposure) {
  EXPECT_NEAR(RangeOf(1.12, 1).BrightnessChange(), 0.12, 0.02);
  EXPECT_FALSE(RangeOf(1.12, 1).IsExposureFixed());
  EXPECT_TRUE(RangeOf(1.12, 1).IsWhiteFixed());
}

TEST(LightMeter, FindsAnotherWhiteBalance) {
  EXPECT_NEAR(RangeOf(1, 1.08).ColorChange(), 0.08, 0.02);
  EXPECT_FALSE(RangeOf(1, 1.08).IsWhiteFixed());
  EXPECT_TRUE(RangeOf(1, 1.08).IsExposureFixed());
}

}  // namespace
}  // namespace mocap
