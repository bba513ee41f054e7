#include "core/reconstruction/pixel_classifier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/reconstruction/coarse_scan.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 120;

class PixelClassifierTest : public ::testing::Test {
 protected:
  PixelClassifierTest()
      : sensor_(2.0f, 11),
        studio_(EmptyStudio(kWidth, kHeight)),
        background_(LearnFixedBackground(TakeBackground(studio_, 30, sensor_), 0.999)),
        classifier_(background_->thresholds(), 0.7f) {}

  void Classify(const ExactPicture& picture) {
    Closeup everything;
    everything.SetAll(kWidth, kHeight);
    expected_ = &background_->Expect(everything, {});
    classifier_.Classify(*expected_, sensor_.Take(picture).view(), {1, 1, 1}, everything);
  }
  // Of the pixels in a box.
  double ShareOf(PixelClass wanted, const PixelBox& box) const {
    int count = 0, all = 0;
    for (int y = box.top; y <= box.bottom; ++y) {
      for (int x = box.left; x <= box.right; ++x) {
        count += classifier_.ClassOf(*expected_, x, y) == wanted;
        ++all;
      }
    }
    return static_cast<double>(count) / all;
  }

  static constexpr PixelBox kPatch{40, 30, 69, 59};

  NoisySensor sensor_;
  ExactPicture studio_;
  std::unique_ptr<BackgroundModel> background_;
  PixelClassifier classifier_;
  const ExpectedPicture* expected_ = nullptr;
};

TEST_F(PixelClassifierTest, TheEmptyStudioIsBackground) {
  Classify(studio_);
  EXPECT_GT(ShareOf(PixelClass::kBackground, {0, 0, kWidth - 1, kHeight - 1}), 0.99);
  EXPECT_LT(ShareOf(PixelClass::kForeground, {0, 0, kWidth - 1, kHeight - 1}), 0.001);
}

TEST_F(PixelClassifierTest, WhatIsEvenlyDarkerIsShadow) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 0.82f);
  Classify(picture);
  EXPECT_GT(ShareOf(PixelClass::kShadow, {44, 34, 65, 55}), 0.99);
}

TEST_F(PixelClassifierTest, WhatIsABitBrighterIsHighlight) {
  ExactPicture picture = studio_;
  // Too small to be a thing of its own.
  Dim(picture, {50, 40, 50, 40}, 1.055f);
  Classify(picture);
  EXPECT_EQ(ShareOf(PixelClass::kHighlight, {50, 40, 50, 40}), 1);
}

TEST_F(PixelClassifierTest, WhatHasAnotherColourIsForeground) {
  ExactPicture picture = studio_;
  Paint(picture, kPatch, {90, 100, 160});
  Classify(picture);
  EXPECT_EQ(ShareOf(PixelClass::kForeground, kPatch), 1);
}

TEST_F(PixelClassifierTest, WhatIsDarkerThanAnyShadowIsForeground) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 0.55f);
  Classify(picture);
  EXPECT_EQ(ShareOf(PixelClass::kForeground, kPatch), 1);
}

TEST_F(PixelClassifierTest, WhatIsMuchBrighterIsForeground) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 1.3f);
  Classify(picture);
  EXPECT_EQ(ShareOf(PixelClass::kForeground, kPatch), 1);
}

TEST_F(PixelClassifierTest, ASoftEdgedShadowIsNoForegroundAnywhere) {
  ExactPicture picture = studio_;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float distance = std::hypot(static_cast<float>(x - 80), static_cast<float>(y - 60));
      const float depth = 0.25f / (1 + std::exp((distance - 30) / 4));
      Dim(picture, {x, y, x, y}, 1 - depth);
    }
  }
  Classify(picture);
  EXPECT_LT(ShareOf(PixelClass::kForeground, {0, 0, kWidth - 1, kHeight - 1}), 0.001);
}

TEST_F(PixelClassifierTest, ClothOfAShadowsBrightnessIsToldApartByItsGrain) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 0.82f);
  std::mt19937 random(12);
  std::normal_distribution<float> grain(1, 0.06f);
  for (int y = kPatch.top; y <= kPatch.bottom; ++y)
    for (int x = kPatch.left; x <= kPatch.right; ++x) Dim(picture, {x, y, x, y}, grain(random));
  Classify(picture);
  EXPECT_GT(ShareOf(PixelClass::kForeground, kPatch), 0.98);
}

TEST_F(PixelClassifierTest, AFaintTintShowsOverAWindow) {
  ExactPicture picture = studio_;
  for (int y = kPatch.top; y <= kPatch.bottom; ++y)
    for (int x = kPatch.left; x <= kPatch.right; ++x) picture(x, y)[2] += 5;
  Classify(picture);
  EXPECT_GT(ShareOf(PixelClass::kForeground, kPatch), 0.85);
}

TEST_F(PixelClassifierTest, WindowsReachNoFartherThanWhatTheyFind) {
  ExactPicture picture = studio_;
  Paint(picture, kPatch, {20, 25, 30});
  Classify(picture);
  EXPECT_EQ(CountSet(classifier_.foreground(), kPatch), 30 * 30);
  EXPECT_EQ(CountSet(classifier_.foreground(), {32, 22, 77, 67}), 30 * 30);
}

TEST(DistortionHistograms, ThresholdsKeepTheWantedRateOnPicturesThatWereNotLearned) {
  NoisySensor sensor(2.0f, 13);
  const ExactPicture studio = EmptyStudio(kWidth, kHeight);
  for (const double rate : {0.99, 0.999}) {
    SCOPED_TRACE(rate);
    const auto background = LearnFixedBackground(TakeBackground(studio, 30, sensor), rate);
    const DistortionThresholds& t = background->thresholds();
    Closeup everything;
    everything.SetAll(kWidth, kHeight);
    DistortionScan scan;
    CoarseScan coarse;
    int cd = 0, low = 0, high = 0, all = 0;
    for (int i = 0; i < 10; ++i) {
      const Image<Bgr> image = sensor.Take(studio);
      coarse.Compare(background->Glance({}, {}), image.view());
      scan.Begin(background->Expect(everything, {}), image.view(), coarse.conditions().gain,
                 everything);
      for (int y = 0; y < kHeight; ++y) {
        const DistortionScan::Row& row = scan.Next();
        for (int x = 0; x < kWidth; ++x) {
          const float alpha = row.alpha_shift[x] * row.alpha_weight[x];
          cd += row.cd_sq[x] > t.cd * t.cd;
          low += alpha < t.alpha_low;
          high += alpha > t.alpha_high;
          ++all;
        }
      }
    }
    const double wanted = (1 - rate) * all;
    for (const int exceeding : {cd, low, high}) {
      EXPECT_LT(exceeding, 1.4 * wanted);
      EXPECT_GT(exceeding, 0.6 * wanted);
    }
  }
}

TEST(DistortionScan, GivesWhatTheFormulasOfOnePixelGive) {
  ExpectedPicture expected(1, 1);
  expected.SetPixel(0, {100, 80, 60}, {2, 4, 3}, 0);
  expected.Weigh({}, 0, 1);
  Image<Bgr> image(1, 1, {90, 85, 50});
  Closeup everything;
  everything.SetAll(image.width(), image.height());
  DistortionScan scan;
  scan.Begin(expected, image.view(), {1, 1, 1}, everything);
  const DistortionScan::Row& row = scan.Next();
  // z = (45, 21.25, 16.667), m = (50, 20, 20): α = z·m / m·m.
  const double alpha = (45 * 50 + 21.25 * 20 + 50.0 / 3 * 20) / (2500 + 400 + 400);
  const double cd_sq = std::pow(45 - alpha * 50, 2) + std::pow(21.25 - alpha * 20, 2) +
                       std::pow(50.0 / 3 - alpha * 20, 2);
  EXPECT_NEAR(row.alpha_shift[0], alpha - 1, 1e-5);
  EXPECT_NEAR(row.cd_sq[0], cd_sq, 1e-3);
  EXPECT_NEAR(row.alpha_weight[0], std::sqrt(3300.0), 1e-3);
  for (const DistortionScan::Windows& windows : row.windows) {
    EXPECT_NEAR(windows.alpha_shift[0], alpha - 1, 1e-5);
    EXPECT_NEAR(windows.cd_sq[0], cd_sq, 1e-2);
    EXPECT_NEAR(windows.roughness_sq[0], 0, 1e-2);
  }
}

TEST(DistortionScan, ABrightnessThatChangesAlongASlopeIsNotRough) {
  ExpectedPicture expected(40, 30);
  Image<Bgr> image(40, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      expected.SetPixel(static_cast<std::size_t>(y * 40 + x), {100, 100, 100}, {1, 1, 1}, 0);
      const auto value = static_cast<std::uint8_t>(60 + x + 2 * y);
      image(x, y) = {value, value, value};
    }
  }
  expected.Weigh({}, 0, 40 * 30);
  image(30, 20) = {255, 255, 255};
  Closeup everything;
  everything.SetAll(image.width(), image.height());
  DistortionScan scan;
  scan.Begin(expected, image.view(), {1, 1, 1}, everything);
  for (int y = 0; y < 30; ++y) {
    const DistortionScan::Row& row = scan.Next();
    for (std::size_t k = 0; k < DistortionScan::kWindows; ++k) {
      const int r = DistortionScan::kRadii_px[k];
      for (int x = r; x < 40 - r && y >= r && y < 30 - r; ++x) {
        if (std::abs(x - 30) <= r && std::abs(y - 20) <= r) {
          EXPECT_GT(row.windows[k].roughness_sq[x], 100);
        } else {
          EXPECT_NEAR(row.windows[k].roughness_sq[x], 0, 0.05);
          EXPECT_NEAR(row.windows[k].alpha_shift[x], (x + 2 * y) / 100.0 - 0.4, 1e-4);
        }
      }
    }
  }
}

}  // namespace
}  // namespace mocap
