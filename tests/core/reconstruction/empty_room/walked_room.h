// Pictures of a room in which somebody walks to and fro.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/empty_room/shown_colors.h"
#include "core/reconstruction/empty_room/steady_picture.h"

namespace mocap::testing {

inline constexpr int kRoomWidth = 96, kRoomHeight = 64, kRoomPictures = 60;

/// Noise of some grey levels, the same for the same number.
inline int RoomNoise(std::uint32_t number) {
  std::uint32_t state = number;
  int sum = 0;
  for (int i = 0; i < 4; ++i) {
    // Mixes all bits: neighbours and successive pictures have nothing in common.
    state = (state ^ state >> 16) * 0x7feb352du;
    state = (state ^ state >> 15) * 0x846ca68bu + 1;
    sum += static_cast<int>(state >> 29) - 3;
  }
  return sum / 2;
}

/// The wall itself, brighter to the right.
inline Bgr RoomWall(int x, int y) {
  const auto value = static_cast<std::uint8_t>(90 + x + (x / 12 + y / 12) % 2 * 8);
  return {value, static_cast<std::uint8_t>(value - 10), static_cast<std::uint8_t>(value - 20)};
}

/// What stands before the wall in a picture; without: the wall's own colour.
using RoomPainter = std::function<Bgr(int picture, int x, int y, const Bgr& wall)>;

inline Image<Bgr> RoomPicture(int picture, const RoomPainter& paint, double light = 1) {
  Image<Bgr> image(kRoomWidth, kRoomHeight);
  for (int y = 0; y < kRoomHeight; ++y) {
    for (int x = 0; x < kRoomWidth; ++x) {
      const Bgr color = paint(picture, x, y, RoomWall(x, y));
      const auto number = static_cast<std::uint32_t>(((picture * 64) + y) * 128 + x) * 3;
      const auto exposed = [&](std::uint8_t value, std::uint32_t channel) {
        const double lit = std::lround(value * light) + RoomNoise(number + channel);
        return static_cast<std::uint8_t>(std::clamp(lit, 0.0, 255.0));
      };
      image(x, y) = {exposed(color.b, 0), exposed(color.g, 1), exposed(color.r, 2)};
    }
  }
  return image;
}

/// Somebody in clothes of many colours, twelve pixels wide, who walks to and fro at all heights.
inline Bgr Walker(int picture, int x, int y, const Bgr& wall) {
  const int left = std::abs(picture * 17 % (2 * kRoomWidth) - kRoomWidth);
  if (x < left || x >= left + 12 || y < 8) return wall;
  const auto shirt = static_cast<std::uint8_t>(20 + (picture * 37 + y) % 200);
  return {shirt, static_cast<std::uint8_t>(255 - shirt), 60};
}

inline std::vector<Image<Bgr>> RoomPictures(const RoomPainter& paint, int count = kRoomPictures) {
  std::vector<Image<Bgr>> pictures;
  // Lamps flicker by two per cent.
  for (int i = 0; i < count; ++i)
    pictures.push_back(RoomPicture(i, paint, 1 + 0.02 * std::sin(2.4 * i)));
  return pictures;
}

inline ShownColors ColorsOf(const std::vector<Image<Bgr>>& pictures) {
  PictureSteadier steadier;
  NoiseMeter noise;
  std::vector<Image<Bgr>> steady;
  for (const Image<Bgr>& picture : pictures) {
    steady.push_back(steadier.Steady(picture.view()).color);
    noise.Add(steady.back().view());
  }
  ShownColors shown(kRoomWidth, kRoomHeight, noise.Tolerance());
  for (const Image<Bgr>& picture : steady) shown.Add(picture.view());
  return shown;
}

/// The wall alone, smooth.
inline Image<Bgr> SmoothWall() {
  Image<Bgr> wall(kRoomWidth, kRoomHeight);
  for (int y = 0; y < kRoomHeight; ++y)
    for (int x = 0; x < kRoomWidth; ++x) wall(x, y) = RoomWall(x, y);
  return Smooth(wall.view());
}

inline int LargestDifference(const Bgr& a, const Bgr& b) {
  return std::max({std::abs(a.b - b.b), std::abs(a.g - b.g), std::abs(a.r - b.r)});
}

}  // namespace mocap::testing
