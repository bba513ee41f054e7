#include "core/reconstruction/empty_room/grey_tolerance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/core/reconstruction/empty_room/walked_room.h"

namespace mocap {
namespace {

using testing::RoomPainter;

GreyTolerance ToleranceOf(const RoomPainter& paint) {
  NoiseMeter meter;
  for (int i = 0; i < 20; ++i) meter.Add(testing::RoomPicture(i, paint).view());
  return meter.Tolerance();
}

/// Four and a half standard deviations of the pictures' noise.
double NoiseTolerance() {
  constexpr std::uint32_t kCount = 10'000;
  double sum = 0, sum_sq = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double noise = testing::RoomNoise(i);
    sum += noise, sum_sq += noise * noise;
  }
  return 4.5 * std::sqrt(sum_sq / kCount - sum / kCount * (sum / kCount));
}

TEST(GreyTolerance, IsThatOfTheNoiseWhoeverWalksThere) {
  const auto wall = [](int, int, int, const Bgr& color) { return color; };
  const GreyTolerance empty = ToleranceOf(wall), walked = ToleranceOf(testing::Walker);
  for (const int value : {80, 120, 160}) {
    EXPECT_NEAR(empty.of[value], NoiseTolerance(), 2) << value;
    EXPECT_NEAR(walked.of[value], empty.of[value], 2) << value;
  }
}

TEST(GreyTolerance, OfRareBrightnessIsTheNearestOne) {
  const auto flickers = [](int picture, int x, int y, const Bgr& color) {
    const auto dark = static_cast<std::uint8_t>(picture % 2 * 30);
    return x < 4 && y < 30 ? Bgr{dark, dark, dark} : color;
  };
  const GreyTolerance tolerance = ToleranceOf(flickers);
  EXPECT_NEAR(tolerance.of[10], NoiseTolerance(), 2);
  EXPECT_NEAR(tolerance.of[250], NoiseTolerance(), 2);
}

TEST(GreyTolerance, OfAPictureWithoutNoiseLeavesRoomForACodec) {
  NoiseMeter meter;
  for (int i = 0; i < 5; ++i) meter.Add(testing::SmoothWall().view());
  const GreyTolerance tolerance = meter.Tolerance();
  EXPECT_EQ(tolerance.of[100], 2);
  EXPECT_TRUE(tolerance.Accepts({100, 100, 100}, {102, 98, 101}));
  EXPECT_FALSE(tolerance.Accepts({100, 100, 100}, {100, 100, 103}));
}

}  // namespace
}  // namespace mocap
