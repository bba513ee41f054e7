#include "core/reconstruction/silhouette/coarse_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/reconstruction/silhouette/background_model.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

// Neither is a multiple of a tile.
constexpr int kScanWidth = 203;
constexpr int kScanHeight = 149;
constexpr PixelBox kPerson{60, 20, 99, 119};

class CoarseScanTest : public ::testing::Test {
 protected:
  CoarseScanTest()
      : sensor_(2.0f, 31),
        studio_(EmptyStudio(kScanWidth, kScanHeight)),
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
  for (int y = 0; y < kScanHeight; ++y) {
    for (int x = 0; x < kScanWidth; ++x) {
      const auto drift = static_cast<float>(5 * std::sin(x / 15.0) * std::cos(y / 20.0));
      picture(x, y)[0] += drift;
      picture(x, y)[2] -= drift;
    }
  }
  EXPECT_GT(Compare(sensor_.Take(picture)).drift, 2);
}

TEST_F(CoarseScanTest, ShiftsOfContoursAreMeasured) {
  const auto stripes = [](float shift) {
    ExactPicture picture = EmptyStudio(kScanWidth, kScanHeight);
    for (int y = 0; y < kScanHeight; ++y)
      for (int x = 0; x < kScanWidth; ++x)
        for (float& value : picture(x, y))
          value += 50 * std::sin((static_cast<float>(x) + shift) / 5);
    return picture;
  };
  background_ = LearnFixedBackground(TakeBackground(stripes(0), 30, sensor_), 0.999);
  EXPECT_EQ(Compare(sensor_.Take(stripes(0))).shift_px, 0);
  EXPECT_NEAR(Compare(sensor_.Take(stripes(0.8f))).shift_px, 0.8, 0.3);
}

TEST(RegionOfInterest, TakesInTheNeighboursOfSuspiciousTilesAndMeasuresBeyondThem) {
  Silhouette suspicious(9, 5);  // Of 67 × 35 pixels.
  suspicious.Set(4, 2);
  suspicious.Set(8, 2);
  RegionOfInterest roi;
  roi.Set(suspicious, 67, 35);
  const auto judged = [&](int y) {
    std::vector<std::pair<int, int>> runs;
    roi.ForEachJudged(y, [&](const PixelRun& run) { runs.emplace_back(run.begin, run.end); });
    return runs;
  };
  const auto measured = [&](int y) {
    std::vector<std::pair<int, int>> runs;
    roi.ForEachMeasured(y, [&](const PixelRun& run) { runs.emplace_back(run.begin, run.end); });
    return runs;
  };
  using Runs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(judged(7), Runs());
  EXPECT_EQ(judged(8), (Runs{{24, 48}, {56, 67}}));
  EXPECT_EQ(judged(31), (Runs{{24, 48}, {56, 67}}));
  EXPECT_EQ(judged(32), Runs());
  for (const int y : {0, 16, 34}) EXPECT_EQ(measured(y), (Runs{{16, 67}})) << y;
}

}  // namespace
}  // namespace mocap
