#include "core/reconstruction/background/displacement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/background_model.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

constexpr int kWidth = 203;
constexpr int kHeight = 149;

// A patterned wall, displaced.
ExactPicture Wall(const Displacement& d) {
  ExactPicture picture(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float u = static_cast<float>(x) - d.x_px, v = static_cast<float>(y) - d.y_px;
      const float grey = 120 + 40 * std::sin(u / 9) * std::cos(v / 7);
      picture(x, y) = {grey, 0.9f * grey, 0.8f * grey};
    }
  }
  return picture;
}

class DisplacementTest : public ::testing::Test {
 protected:
  DisplacementTest()
      : sensor_(2.0f, 41),
        background_(LearnFixedBackground(TakeBackground(Wall({}), 20, sensor_), 0.999)) {}

  std::optional<Displacement> Measure(const ExactPicture& picture) {
    HalfPicture live(kWidth, kHeight);
    Halve(sensor_.Take(picture).view(), live);
    return MeasureDisplacement(live, 1, background_->CoarsePass({}, {}));
  }

  NoisySensor sensor_;
  std::unique_ptr<BackgroundModel> background_;
};

TEST_F(DisplacementTest, IsMeasuredToAFewHundredthsOfAPixel) {
  for (const Displacement& d : {Displacement{0, 0}, {1.4f, 0}, {-0.3f, -1.3f}, {0.6f, 0.9f}}) {
    const auto measured = Measure(Wall(d));
    ASSERT_TRUE(measured);
    EXPECT_NEAR(measured->x_px, d.x_px, 0.06);
    EXPECT_NEAR(measured->y_px, d.y_px, 0.06);
  }
}

TEST_F(DisplacementTest, IsNotDisturbedByAPerson) {
  ExactPicture picture = Wall({-0.3f, -1.3f});
  Paint(picture, {70, 20, 120, 148}, {30, 20, 60});
  const auto measured = Measure(picture);
  ASSERT_TRUE(measured);
  EXPECT_NEAR(measured->x_px, -0.3, 0.1);
  EXPECT_NEAR(measured->y_px, -1.3, 0.1);
}

TEST_F(DisplacementTest, IsUnknownWithoutContours) {
  const ExactPicture plain(kWidth, kHeight, {120, 110, 100});
  background_ = LearnFixedBackground(TakeBackground(plain, 20, sensor_), 0.999);
  EXPECT_FALSE(Measure(plain));
}

TEST_F(DisplacementTest, WhatIsExpectedFollowsIt) {
  const Displacement d{1.25f, -0.5f};
  RegionOfInterest everything;
  everything.SetAll(kWidth, kHeight);
  const ExpectedHalf half = background_->CoarsePass({}, d);
  const ExpectedPicture& full = background_->Expect(everything, {.displacement = d});
  const ExactPicture wall = Wall(d);
  HalfPicture exact(kWidth, kHeight);
  NoisySensor none(0.01f, 42);
  Halve(none.Take(wall).view(), exact);
  for (int y = 4; y < kHeight - 10; ++y) {
    for (int x = 4; x < kWidth - 10; ++x) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(full.mean[c][static_cast<std::size_t>(y * kWidth + x)], wall(x, y)[c], 2.5);
        const std::size_t i =
            static_cast<std::size_t>(y / HalfPicture::kRowStep_px * half.mean.width + x / 2);
        EXPECT_NEAR(half.mean.color[c][i], exact.color[c][i], 2.5);
      }
    }
  }
  // What was displaced into the picture is not known.
  EXPECT_EQ(full.variance[0][0], kUnknownVariance);
  EXPECT_EQ(half.variance[0], kUnknownVariance);
}

}  // namespace
}  // namespace mocap
