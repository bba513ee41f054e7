#include "core/reconstruction/background/half_picture.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace mocap {
namespace {

Image<Bgr> RandomPicture(int width, int height) {
  std::mt19937 random(1);
  // Neighbours that differ little are rounded in every way there is.
  std::uniform_int_distribution<int> level(100, 103), any(0, 255), kind(0, 1);
  Image<Bgr> picture(width, height);
  const auto draw = [&] {
    return static_cast<std::uint8_t>(kind(random) == 0 ? any(random) : level(random));
  };
  for (Bgr& p : picture.pixels()) p = {draw(), draw(), draw()};
  return picture;
}

constexpr int kRowStep_px = HalfPicture::kRowStep_px;

// The plain definition: rounded to the nearest, and up from the middle.
Bgr MeanOfFour(const Image<Bgr>& picture, int x, int y) {
  const auto mean = [&](std::uint8_t Bgr::*channel) {
    const int v = kRowStep_px * y;
    const int sum = picture(2 * x, v).*channel + picture(2 * x + 1, v).*channel +
                    picture(2 * x, v + 1).*channel + picture(2 * x + 1, v + 1).*channel;
    return static_cast<std::uint8_t>((sum + 2) / 4);
  };
  return {mean(&Bgr::b), mean(&Bgr::g), mean(&Bgr::r)};
}

Bgr PixelOf(const HalfPicture& half, int x, int y) {
  const std::size_t i = static_cast<std::size_t>(y) * half.width + x;
  return {half.color[0][i], half.color[1][i], half.color[2][i]};
}

TEST(HalfPicture, EachPixelIsTheMeanOfFour) {
  Image<Bgr> image(5, 6);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 5; ++x)
      image(x, y) = {static_cast<std::uint8_t>(10 * x), static_cast<std::uint8_t>(20 * y),
                     static_cast<std::uint8_t>(x == 3 && y == 5 ? 255 : 0)};
  HalfPicture half(5, 6);
  Halve(image.view(), half);
  ASSERT_EQ(half.width, 4);
  ASSERT_EQ(half.height, 2);
  EXPECT_EQ(half.color[0][0], 5);
  EXPECT_EQ(half.color[0][1], 25);
  EXPECT_EQ(half.color[1][0], 10);
  EXPECT_EQ(half.color[1][half.width], 90);
  EXPECT_EQ(half.color[2][half.width + 1], 64);
  EXPECT_EQ(half.color[0][2], 0);
}

// The plain definition, padding and all.
float MeanOfTile(const HalfPicture& half, int channel, int row, int column) {
  constexpr int kTile = HalfPicture::kTile, kRows = HalfPicture::kTileRows;
  float sum = 0;
  for (int y = row * kRows; y < (row + 1) * kRows; ++y)
    for (int x = column * kTile; x < (column + 1) * kTile; ++x)
      sum += half.color[channel][static_cast<std::size_t>(y) * half.width + x];
  return sum / (kTile * kRows);
}

TEST(HalfPicture, TilesAreMeansOfTheirPixels) {
  for (const auto& [width, height] : {std::pair{640, 48}, {202, 30}, {38, 22}, {8, 8}, {6, 4}}) {
    const Image<Bgr> picture = RandomPicture(width, height);
    HalfPicture half(width, height);
    Halve(picture.view(), half);
    for (int c = 0; c < 3; ++c)
      for (int row = 0; row < half.tile_rows(); ++row)
        for (int column = 0; column < half.tile_columns(); ++column)
          ASSERT_EQ(half.tile_mean[c][static_cast<std::size_t>(row * half.tile_columns() + column)],
                    MeanOfTile(half, c, row, column))
              << column << ", " << row << " of " << width << " x " << height;
  }
}

TEST(HalfPicture, PixelsAreMeansOfFourAndThePaddingIsBlack) {
  for (const auto& [width, height] : {std::pair{640, 48}, {202, 30}, {38, 22}, {6, 4}}) {
    const Image<Bgr> picture = RandomPicture(width, height);
    HalfPicture half(width, height);
    Halve(picture.view(), half);
    for (int y = 0; y < half.height; ++y) {
      for (int x = 0; x < half.width; ++x) {
        const bool is_in_picture = x < width / 2 && kRowStep_px * y + 1 < height;
        ASSERT_EQ(PixelOf(half, x, y), is_in_picture ? MeanOfFour(picture, x, y) : Bgr{})
            << x << ", " << y << " of " << width << " x " << height;
      }
    }
  }
}

}  // namespace
}  // namespace mocap
