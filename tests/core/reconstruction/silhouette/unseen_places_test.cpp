#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/reconstruction/silhouette/segmenter.h"
#include "tests/core/reconstruction/lenses.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

constexpr int kAcross = 200, kDown = 150;

CameraCalibration PartlySeenCamera() {
  CameraCalibration camera;
  camera.name = "cam3";
  camera.width_px = kAcross;
  camera.height_px = kDown;
  camera.lens = OpenCvLens{PinholeMatrix(200, 200, 100, 75), {}};
  return camera;
}

/// Somebody stood before a part of the wall while the background was learned.
class PartlySeenStudio : public ::testing::Test {
 protected:
  static constexpr PixelBox kHidden{120, 40, 149, 99};

  PartlySeenStudio() : sensor_(2.0f, 21), studio_(EmptyStudio(kAcross, kDown)) {
    ExactPicture learned = studio_;
    Paint(learned, kHidden, {40, 150, 60});
    std::vector<BackgroundFrame> background = TakeBackground(learned, 30, sensor_);
    background[0].unseen.Reset(kAcross, kDown);
    for (int y = kHidden.top; y <= kHidden.bottom; ++y)
      for (int x = kHidden.left; x <= kHidden.right; ++x) background[0].unseen.Set(x, y);
    segmenter_.emplace(PartlySeenCamera(), background, SegmentationOptions{});
  }
  static constexpr int Area(const PixelBox& box) {
    return (box.right - box.left + 1) * (box.bottom - box.top + 1);
  }
  Trimap See(const ExactPicture& picture) {
    Trimap trimap;
    segmenter_->Segment(sensor_.Take(picture).view(), {}, trimap);
    return trimap;
  }

  NoisySensor sensor_;
  ExactPicture studio_;
  std::optional<Segmenter> segmenter_;
};

TEST_F(PartlySeenStudio, WhatWasNeverSeenEmptyIsUnknownWhateverItShows) {
  const Trimap wall = See(studio_);
  EXPECT_EQ(CountSet(wall.person), 0);
  EXPECT_EQ(CountSet(wall.unknown, kHidden), Area(kHidden));
  ExactPicture picture = studio_;
  Dim(picture, kHidden, 0.6f);
  const Trimap dark = See(picture);
  EXPECT_EQ(CountSet(dark.person), 0);
  EXPECT_EQ(CountSet(dark.unknown, kHidden), Area(kHidden));
  EXPECT_EQ(CountSet(segmenter_->shading().dark, kHidden), 0);
  const Shading& shading = segmenter_->shading();
  EXPECT_EQ(shading.shades[static_cast<std::size_t>(8 * shading.tile_columns + 17)],
            Shading::kUnknown);
}

TEST_F(PartlySeenStudio, SomebodyBeforeItIsSeenBesideItAndNotDenied) {
  ExactPicture picture = studio_;
  const PixelBox person{100, 30, 139, 120};
  Paint(picture, person, {40, 50, 160});
  const Trimap trimap = See(picture);
  EXPECT_NEAR(CountSet(trimap.person, {100, 30, 119, 120}), 20 * 91, 20);
  for (int y = kHidden.top; y <= kHidden.bottom; ++y)
    for (int x = kHidden.left; x <= kHidden.right; ++x)
      ASSERT_NE(trimap.person.Test(x, y), trimap.unknown.Test(x, y)) << x << " " << y;
}

TEST_F(PartlySeenStudio, APersonAroundItIsWhole) {
  ExactPicture picture = studio_;
  Paint(picture, {100, 20, 169, 130}, {40, 50, 160});
  EXPECT_NEAR(CountSet(See(picture).person), 70 * 111, 80);
}

TEST_F(PartlySeenStudio, ItMovesWithACameraThatWasNudged) {
  // A wall with enough contours to measure by.
  const auto look = [](double x_px, double y_px) {
    ExactPicture picture(kAcross, kDown);
    for (int y = 0; y < kDown; ++y) {
      for (int x = 0; x < kAcross; ++x) {
        const double wave = std::sin((x - x_px) / 5) * std::cos((y - y_px) / 6);
        const auto grey = static_cast<float>(130 + 60 * std::tanh(3 * wave));
        picture(x, y) = {grey, 0.9f * grey, 0.8f * grey};
      }
    }
    return picture;
  };
  std::vector<BackgroundFrame> background = TakeBackground(look(0, 0), 30, sensor_);
  background[0].unseen.Reset(kAcross, kDown);
  for (int y = 68; y <= 72; ++y)
    for (int x = 118; x <= 122; ++x) background[0].unseen.Set(x, y);
  segmenter_.emplace(PartlySeenCamera(), background, SegmentationOptions{});
  const Trimap trimap = See(look(3, -2));
  const Displacement displacement = segmenter_->conditions().displacement;
  ASSERT_NE(displacement, Displacement{});
  EXPECT_TRUE(trimap.unknown.Test(123, 68)) << displacement.x_px << " " << displacement.y_px;
  EXPECT_FALSE(trimap.unknown.Test(118, 72)) << displacement.x_px << " " << displacement.y_px;
}

}  // namespace
}  // namespace mocap
