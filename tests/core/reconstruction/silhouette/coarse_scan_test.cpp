#include "core/reconstruction/silhouette/coarse_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/reconstruction/background/background_model.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

// Neither is a multiple of a tile.
constexpr int kWidth = 203;
constexpr int kHeight = 149;
constexpr PixelBox kPerson{60, 20, 99, 119};

class CoarseScanTest : public ::testing::Test {
 protected:
  CoarseScanTest()
      : sensor_(2.0f, 31),
        studio_(EmptyStudio(kWidth, kHeight)),
        background_(LearnFixedBackground(TakeBackground(studio_, 30, sensor_), 0.999)) {}

  const Conditions& Compare(const Image<Bgr>& image) {
    scan_.Compare(background_->CoarsePass({}, {}), image.view());
    return scan_.conditions();
  }

  NoisySensor sensor_;
  ExactPicture studio_;
  std::unique_ptr<BackgroundModel> background_;
  CoarseScan scan_;
};

TEST_F(CoarseScanTest, NothingIsSuspiciousInTheEmptyStudio) {
  for (int i = 0; i < 10; ++i) {
    const Conditions& conditions = Compare(sensor_.Take(studio_));
    EXPECT_EQ(CountSet(scan_.suspicious()), 0);
    EXPECT_EQ(conditions.drift, 0);
    EXPECT_EQ(conditions.shift_px, 0);
  }
}

TEST_F(CoarseScanTest, TheGainUndoesFlickerAndTintsOfTheLightDespiteAPerson) {
  ExactPicture picture = studio_;
  Paint(picture, {20, 10, 119, 129}, {30, 20, 25});
  for (auto& color : picture.pixels()) color[0] *= 0.97f, color[1] *= 1.02f, color[2] *= 1.05f;
  const Conditions& conditions = Compare(sensor_.Take(picture));
  EXPECT_NEAR(conditions.gain[0], 1 / 0.97, 0.005);
  EXPECT_NEAR(conditions.gain[1], 1 / 1.02, 0.005);
  EXPECT_NEAR(conditions.gain[2], 1 / 1.05, 0.005);
}

TEST_F(CoarseScanTest, APersonIsSuspiciousAllOver) {
  ExactPicture picture = studio_;
  Paint(picture, kPerson, {60, 60, 70});
  Compare(sensor_.Take(picture));
  const Silhouette& tiles = scan_.suspicious();
  for (int y = kPerson.top / 8; y <= kPerson.bottom / 8; ++y)
    for (int x = kPerson.left / 8; x <= kPerson.right / 8; ++x)
      EXPECT_TRUE(tiles.Test(x, y)) << x << " " << y;
  EXPECT_LT(CountSet(tiles), 2 * 6 * 14);
}

TEST_F(CoarseScanTest, AnArmThinnerThanATileIsSuspicious) {
  ExactPicture picture = studio_;
  Paint(picture, {20, 61, 140, 63}, {100, 130, 190});
  Compare(sensor_.Take(picture));
  for (int x = 20 / 8; x <= 140 / 8; ++x) EXPECT_TRUE(scan_.suspicious().Test(x, 62 / 8)) << x;
}

TEST_F(CoarseScanTest, AnEvenShadowIsNotWorthALook) {
  ExactPicture picture = studio_;
  Dim(picture, kPerson, 0.85f);
  Compare(sensor_.Take(picture));
  EXPECT_EQ(CountSet(scan_.suspicious(), {9, 4, 10, 12}), 0);
}

TEST_F(CoarseScanTest, TheSoftEdgeOfAShadowIsNotWorthALook) {
  ExactPicture picture = studio_;
  for (int x = 60; x < 100; ++x) {
    const auto edge = static_cast<float>(std::min({x - 60, 99 - x, 12})) / 12;
    Dim(picture, {x, 20, x, 119}, 1 - 0.2f * edge);
  }
  Compare(sensor_.Take(picture));
  EXPECT_EQ(CountSet(scan_.suspicious(), {7, 4, 13, 12}), 0);
}

TEST_F(CoarseScanTest, TheHardEdgeOfWhatIsGreyIsSuspicious) {
  ExactPicture picture = studio_;
  Dim(picture, {60, 20, 91, 119}, 0.7f);
  Compare(sensor_.Take(picture));
  for (int y = 24 / 8; y < 112 / 8; ++y) {
    EXPECT_TRUE(scan_.suspicious().Test(60 / 8, y)) << y;
    EXPECT_TRUE(scan_.suspicious().Test(91 / 8, y)) << y;
  }
}

TEST_F(CoarseScanTest, DriftOfWallsIsMeasured) {
  ExactPicture picture = studio_;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto drift = static_cast<float>(5 * std::sin(x / 15.0) * std::cos(y / 20.0));
      picture(x, y)[0] += drift;
      picture(x, y)[2] -= drift;
    }
  }
  EXPECT_GT(Compare(sensor_.Take(picture)).drift, 2);
}

TEST_F(CoarseScanTest, ShiftsOfContoursAreMeasured) {
  const auto stripes = [](float shift) {
    ExactPicture picture = EmptyStudio(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        for (float& value : picture(x, y))
          value += 50 * std::sin((static_cast<float>(x) + shift) / 5);
    return picture;
  };
  background_ = LearnFixedBackground(TakeBackground(stripes(0), 30, sensor_), 0.999);
  EXPECT_EQ(Compare(sensor_.Take(stripes(0))).shift_px, 0);
  EXPECT_NEAR(Compare(sensor_.Take(stripes(0.8f))).shift_px, 0.8, 0.3);
}

// Looks as a camera that runs does, and as if every picture were the first.
class WatchTest : public CoarseScanTest {
 protected:
  void Show(const ExactPicture& picture) {
    const Image<Bgr> image = sensor_.Take(picture);
    scan_.Watch(background_->CoarsePass({}, {}), image.view());
    plain_.Compare(background_->CoarsePass({}, {}), image.view());
  }
  ExactPicture PersonAt(const PixelBox& box) const {
    ExactPicture picture = studio_;
    Paint(picture, box, {60, 60, 70});
    return picture;
  }
  bool SeesAll() const { return scan_.suspicious().words() == plain_.suspicious().words(); }

  CoarseScan plain_;
};

TEST_F(WatchTest, WhoComesInIsSeenAtOnce) {
  for (int i = 0; i < 10; ++i) Show(studio_);
  for (int i = 0; i < CoarseScan::kBandRows; ++i) {
    Show(PersonAt({0, 20, 10 + 4 * i, 119}));
    EXPECT_GT(CountSet(scan_.suspicious()), 20);
    EXPECT_TRUE(SeesAll()) << i;
  }
}

TEST_F(WatchTest, WhoWalksOrLeapsIsSeenWhole) {
  for (const int left : {20, 30, 34, 120, 128, 10, 14, 50}) {
    Show(PersonAt({left, 20, left + 39, 119}));
    EXPECT_TRUE(SeesAll()) << left;
  }
}

TEST_F(WatchTest, SomebodyElseIsSeenBesideThePerson) {
  for (int i = 0; i < 4; ++i) Show(PersonAt({20, 20, 49, 119}));
  ExactPicture picture = PersonAt({20, 20, 49, 119});
  Paint(picture, {150, 30, 179, 109}, {60, 60, 70});
  Show(picture);
  EXPECT_TRUE(SeesAll());
}

TEST_F(WatchTest, WhatIsSmallIsSeenWhenItsRowsTurnComes) {
  for (int i = 0; i < 4; ++i) Show(studio_);
  int pictures = 0;
  do {
    Show(PersonAt({120, 40, 139, 59}));
    ++pictures;
  } while (!SeesAll() && pictures < 3 * CoarseScan::kBandRows);
  EXPECT_LE(pictures, CoarseScan::kBandRows);
  Show(PersonAt({120, 40, 139, 59}));
  EXPECT_TRUE(SeesAll());
}

TEST_F(WatchTest, FlickerIsMeasuredWhateverIsLookedAt) {
  for (int i = 0; i < 20; ++i) {
    const float light = i % 2 == 0 ? 0.96f : 1.03f;
    ExactPicture picture = PersonAt({20 + 3 * i, 20, 59 + 3 * i, 119});
    for (auto& color : picture.pixels())
      for (float& value : color) value *= light;
    Show(picture);
    EXPECT_NEAR(scan_.conditions().gain[1], 1 / light, 0.01) << i;
  }
}

TEST(RegionOfInterest, TakesInTheNeighboursOfSuspiciousTilesAndMeasuresBeyondThem) {
  Silhouette suspicious(9, 5);  // Of 67 × 35 pixels.
  suspicious.Set(4, 2);
  suspicious.Set(8, 2);
  RegionOfInterest roi;
  roi.Set(suspicious, 67, 35);
  EXPECT_TRUE(roi.Judged(7).empty());
  ASSERT_EQ(roi.Judged(8).size(), 2u);
  EXPECT_EQ(roi.Judged(8)[0].begin, 24);
  EXPECT_EQ(roi.Judged(8)[0].end, 48);
  EXPECT_EQ(roi.Judged(8)[1].begin, 56);
  EXPECT_EQ(roi.Judged(8)[1].end, 67);
  EXPECT_EQ(roi.Judged(31).size(), 2u);
  EXPECT_TRUE(roi.Judged(32).empty());
  EXPECT_TRUE(roi.Measured(3).empty());
  for (const int y : {4, 16, 34}) {
    ASSERT_EQ(roi.Measured(y).size(), 1u) << y;
    EXPECT_EQ(roi.Measured(y)[0].begin, 20);
    EXPECT_EQ(roi.Measured(y)[0].end, 67);
  }
}

}  // namespace
}  // namespace mocap
