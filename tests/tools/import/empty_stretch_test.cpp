// Stretches without people.
#include "tools/import/empty_stretch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mocap {
namespace {

/// A dark person, or nobody, before a noisy wall.
Image<Bgr> Room(std::optional<int> person_at, unsigned seed) {
  Image<Bgr> image(192, 96, {150, 140, 130});
  std::mt19937 random(seed);
  for (Bgr& pixel : image.pixels()) pixel.g = static_cast<std::uint8_t>(pixel.g + random() % 9);
  for (int y = 20; person_at && y < 96; ++y)
    for (int x = 0; x < 192; ++x)
      if (std::abs(x - *person_at) < 12) image(x, y) = {40, 40, 40};
  return image;
}

TEST(EmptyStretch, IsFoundBetweenPeople) {
  EmptyStretch stretch;
  for (int i = 0; i < 60; ++i) {
    const bool is_empty = i >= 20 && i < 32;
    stretch.Add(i * 0.5, Room(is_empty ? std::nullopt : std::optional((i * 37) % 192),
                              static_cast<unsigned>(i))
                             .view());
  }
  const auto longest = stretch.Longest();
  ASSERT_TRUE(longest);
  EXPECT_DOUBLE_EQ(longest->from_s, 10);
  EXPECT_DOUBLE_EQ(longest->to_s, 15.5);
}

TEST(EmptyStretch, IsNoneWhilePeopleMoveAllTheTime) {
  EmptyStretch stretch;
  for (int i = 0; i < 60; ++i) stretch.Add(i * 0.5, Room((i * 37) % 192, 1).view());
  EXPECT_FALSE(stretch.Longest());
}

TEST(EmptyStretch, IsNoneIfNothingEverChanges) {
  // Somebody who sits still is part of the room by then.
  EmptyStretch stretch;
  for (int i = 0; i < 60; ++i) stretch.Add(i * 0.5, Room(90, static_cast<unsigned>(i)).view());
  EXPECT_FALSE(stretch.Longest());
}

TEST(EmptyStretch, LastsTwoSecondsAtLeast) {
  EmptyStretch stretch;
  for (int i = 0; i < 60; ++i) {
    const bool is_empty = i >= 20 && i < 26;
    stretch.Add(i * 0.25, Room(is_empty ? std::nullopt : std::optional((i * 37) % 192), 1).view());
  }
  EXPECT_FALSE(stretch.Longest());
}

}  // namespace
}  // namespace mocap
