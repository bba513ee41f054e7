#include "core/reconstruction/silhouette/pixel_classifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "core/reconstruction/silhouette/segmentation_constants.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

constexpr int kClassifiedWidth = 160;
constexpr int kClassifiedHeight = 120;

class PixelClassifierTest : public ::testing::Test {
 protected:
  PixelClassifierTest()
      : sensor_(2.0f, 11),
        studio_(EmptyStudio(kClassifiedWidth, kClassifiedHeight)),
        background_(LearnFixedBackground(TakeBackground(studio_, 30, sensor_), 0.999)),
        classifier_(background_->thresholds(), 0.7f) {}

  void Classify(const ExactPicture& picture) {
    RegionOfInterest everything;
    everything.SetAll(kClassifiedWidth, kClassifiedHeight);
    classifier_.Classify(background_->Expect(everything, {}), sensor_.Take(picture).view(), {},
                         everything);
  }
  // Of the pixels in a box.
  static double ShareOf(const Silhouette& pixels, const PixelBox& box) {
    return CountSet(pixels, box) /
           static_cast<double>((box.right + 1 - box.left) * (box.bottom + 1 - box.top));
  }

  static constexpr PixelBox kPatch{40, 30, 69, 59};

  NoisySensor sensor_;
  ExactPicture studio_;
  std::unique_ptr<BackgroundModel> background_;
  PixelClassifier classifier_;
};

// Pixels are judged eight at a time, two rows at once.
TEST(PixelClassifier, DecisionsEndWhereThePictureDoes) {
  NoisySensor sensor(2.0f, 11);
  for (const auto& [width, height] : {std::pair{150, 45}, {161, 32}, {67, 9}}) {
    const ExactPicture studio = EmptyStudio(width, height);
    const auto background = LearnFixedBackground(TakeBackground(studio, 30, sensor), 0.999);
    PixelClassifier classifier(background->thresholds(), 0.7f);
    RegionOfInterest everything;
    everything.SetAll(width, height);
    ExactPicture picture = studio;
    Paint(picture, {0, 0, width - 1, height - 1}, {20, 25, 30});
    classifier.Classify(background->Expect(everything, {}), sensor.Take(picture).view(), {},
                        everything);
    const Silhouette& foreground = classifier.foreground();
    EXPECT_EQ(CountSet(foreground), width * height);
    for (int y = 0; y < height; ++y)
      EXPECT_EQ(foreground.row(y)[width / 64] >> width % 64, 0u) << width << " " << y;
  }
}

TEST_F(PixelClassifierTest, TheEmptyStudioIsBackground) {
  Classify(studio_);
  EXPECT_LT(ShareOf(classifier_.foreground(), {0, 0, kClassifiedWidth - 1, kClassifiedHeight - 1}),
            0.001);
}

TEST_F(PixelClassifierTest, WhatIsEvenlyDarkerIsShadow) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 0.82f);
  Classify(picture);
  EXPECT_GT(ShareOf(classifier_.dark(), {44, 34, 65, 55}), 0.99);
  EXPECT_LT(ShareOf(classifier_.foreground(), {44, 34, 65, 55}), 0.01);
}

TEST_F(PixelClassifierTest, WhatIsABitBrighterIsNoForeground) {
  ExactPicture picture = studio_;
  // Too small to be a thing of its own.
  Dim(picture, {50, 40, 50, 40}, 1.055f);
  Classify(picture);
  EXPECT_FALSE(classifier_.foreground().Test(50, 40));
}

TEST_F(PixelClassifierTest, WhatHasAnotherColourIsForeground) {
  ExactPicture picture = studio_;
  Paint(picture, kPatch, {90, 100, 160});
  Classify(picture);
  EXPECT_EQ(ShareOf(classifier_.foreground(), kPatch), 1);
}

TEST_F(PixelClassifierTest, WhatIsDarkerThanAnyShadowIsForeground) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 0.55f);
  Classify(picture);
  EXPECT_EQ(ShareOf(classifier_.foreground(), kPatch), 1);
}

TEST_F(PixelClassifierTest, WhatIsMuchBrighterIsForeground) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 1.3f);
  Classify(picture);
  EXPECT_EQ(ShareOf(classifier_.foreground(), kPatch), 1);
}

TEST_F(PixelClassifierTest, ASoftEdgedShadowIsNoForegroundAnywhere) {
  ExactPicture picture = studio_;
  for (int y = 0; y < kClassifiedHeight; ++y) {
    for (int x = 0; x < kClassifiedWidth; ++x) {
      const float distance = std::hypot(static_cast<float>(x - 80), static_cast<float>(y - 60));
      const float depth = 0.25f / (1 + std::exp((distance - 30) / 4));
      Dim(picture, {x, y, x, y}, 1 - depth);
    }
  }
  Classify(picture);
  EXPECT_LT(ShareOf(classifier_.foreground(), {0, 0, kClassifiedWidth - 1, kClassifiedHeight - 1}),
            0.001);
}

TEST_F(PixelClassifierTest, ClothOfAShadowsBrightnessIsToldApartByItsGrain) {
  ExactPicture picture = studio_;
  Dim(picture, kPatch, 0.82f);
  std::mt19937 random(12);
  std::normal_distribution<float> grain(1, 0.06f);
  for (int y = kPatch.top; y <= kPatch.bottom; ++y)
    for (int x = kPatch.left; x <= kPatch.right; ++x) Dim(picture, {x, y, x, y}, grain(random));
  Classify(picture);
  EXPECT_GT(ShareOf(classifier_.foreground(), kPatch), 0.98);
}

TEST_F(PixelClassifierTest, AFaintTintShowsOverAWindow) {
  ExactPicture picture = studio_;
  for (int y = kPatch.top; y <= kPatch.bottom; ++y)
    for (int x = kPatch.left; x <= kPatch.right; ++x) picture(x, y)[2] += 5;
  Classify(picture);
  EXPECT_GT(ShareOf(classifier_.foreground(), kPatch), 0.85);
}

TEST_F(PixelClassifierTest, WindowsReachNoFartherThanWhatTheyFind) {
  ExactPicture picture = studio_;
  Paint(picture, kPatch, {20, 25, 30});
  Classify(picture);
  EXPECT_EQ(CountSet(classifier_.foreground(), kPatch), 30 * 30);
  EXPECT_EQ(CountSet(classifier_.foreground(), {32, 22, 77, 67}), 30 * 30);
}

// What the headers say, in double precision and pixel by pixel.
class PlainClassifier {
 public:
  PlainClassifier(const ExpectedPicture& expected, const Image<Bgr>& image,
                  const DistortionThresholds& thresholds, double darkest_shadow)
      : width_(expected.width),
        height_(expected.height),
        shift_(width_, height_),
        weight_(width_, height_),
        distance_(width_, height_, Eigen::Vector3d::Zero()) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) Measure(expected, image, x, y);
    clear_ = Image<std::uint8_t>(width_, height_);
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const double alpha = shift_(x, y) * weight_(x, y);
        clear_(x, y) = distance_(x, y).norm() > segmentation::kPixelMargin * thresholds.cd ||
                       (shift_(x, y) < darkest_shadow - 1 &&
                        alpha < segmentation::kPixelMargin * thresholds.alpha_low);
      }
    }
    for (const std::size_t k : {0, 1}) {
      clear_windows_[k] = Image<std::uint8_t>(width_, height_);
      for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x)
          clear_windows_[k](x, y) = IsClearWindow(k, x, y, thresholds.windows[k], darkest_shadow);
    }
  }

  bool IsForeground(int x, int y) const {
    return clear_(x, y) || (AllClearAround(0, x, y) && AllClearAround(1, x, y));
  }

 private:
  void Measure(const ExpectedPicture& expected, const Image<Bgr>& image, int x, int y) {
    const auto i = static_cast<std::size_t>(y * width_ + x);
    const Eigen::Vector3d color(image(x, y).b, image(x, y).g, image(x, y).r);
    Eigen::Vector3d z, m;
    for (int c = 0; c < 3; ++c) {
      const double sigma = std::sqrt(static_cast<double>(expected.variance[c][i]));
      z[c] = color[c] / sigma;
      m[c] = expected.mean[c][i] / sigma;
    }
    const double alpha = z.dot(m) / m.squaredNorm();
    shift_(x, y) = alpha - 1;
    weight_(x, y) = m.norm();
    distance_(x, y) = z - alpha * m;
  }

  bool IsClearWindow(std::size_t k, int x, int y, const DistortionThresholds::Window& t,
                     double darkest_shadow) const {
    const int radius = kernels::kWindowRadii_px[k];
    const double margin = segmentation::kWindowMargins[k];
    const double area = (2 * radius + 1) * (2 * radius + 1);
    const double spread = area * (area - 1) / 12;
    double sum = 0, sum_sq = 0, along = 0, down = 0;
    Eigen::Vector3d distance = Eigen::Vector3d::Zero();
    for (int v = -radius; v <= radius; ++v) {
      for (int u = -radius; u <= radius; ++u) {
        const int column = std::clamp(x + u, 0, width_ - 1);
        const int row = std::clamp(y + v, 0, height_ - 1);
        const double a = shift_(column, row);
        sum += a, sum_sq += a * a, along += u * a, down += v * a;
        distance += distance_(column, row);
      }
    }
    const double alpha = sum / area * weight_(x, y);
    const double roughness_sq =
        (sum_sq - sum * sum / area - (along * along + down * down) / spread) / area;
    const bool is_dark = sum / area < darkest_shadow - 1 && alpha < -margin * t.alpha;
    return is_dark || alpha > margin * t.alpha || distance.norm() / area > margin * t.cd ||
           std::sqrt(std::max(roughness_sq, 0.0)) * weight_(x, y) > margin * t.roughness;
  }

  bool AllClearAround(std::size_t k, int x, int y) const {
    const int radius = kernels::kWindowRadii_px[k];
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height_ - 1); ++v)
      for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width_ - 1); ++u)
        if (!clear_windows_[k](u, v)) return false;
    return true;
  }

  int width_, height_;
  Image<double> shift_, weight_;
  Image<Eigen::Vector3d> distance_;
  Image<std::uint8_t> clear_;
  std::array<Image<std::uint8_t>, 2> clear_windows_;
};

TEST_F(PixelClassifierTest, AgreesWithItsDefinitionPixelByPixel) {
  ExactPicture picture = studio_;
  Dim(picture, {0, 0, 40, 40}, 0.8f);
  Paint(picture, {30, 20, 62, 80}, {95, 105, 118});
  Paint(picture, {100, 90, kClassifiedWidth - 1, kClassifiedHeight - 1}, {60, 60, 90});
  for (int y = 60; y < 100; ++y)
    for (int x = 20; x < 90; ++x) picture(x, y)[0] += static_cast<float>(y - 60) / 6;
  const Image<Bgr> image = sensor_.Take(picture);
  RegionOfInterest everything;
  everything.SetAll(kClassifiedWidth, kClassifiedHeight);
  const ExpectedPicture& expected = background_->Expect(everything, {});
  classifier_.Classify(expected, image.view(), {}, everything);
  const PlainClassifier plain(expected, image, background_->thresholds(), 0.7f);
  int foreground = 0;
  for (int y = 0; y < kClassifiedHeight; ++y) {
    for (int x = 0; x < kClassifiedWidth; ++x) {
      ASSERT_EQ(classifier_.foreground().Test(x, y), plain.IsForeground(x, y)) << x << " " << y;
      foreground += plain.IsForeground(x, y);
    }
  }
  EXPECT_GT(foreground, 2000);
  EXPECT_LT(foreground, kClassifiedWidth * kClassifiedHeight / 2);
}

TEST_F(PixelClassifierTest, ARegionOfInterestShowsWhatTheWholePictureShows) {
  ExactPicture picture = studio_;
  Paint(picture, kPatch, {90, 100, 160});
  Paint(picture, {120, 0, kClassifiedWidth - 1, 20}, {60, 60, 90});
  const Image<Bgr> image = sensor_.Take(picture);
  RegionOfInterest everything, part;
  everything.SetAll(kClassifiedWidth, kClassifiedHeight);
  Silhouette suspicious(kClassifiedWidth / 8, kClassifiedHeight / 8);
  for (int y = 3; y <= 7; ++y)
    for (int x = 5; x <= 8; ++x) suspicious.Set(x, y);
  for (int x = 15; x < 20; ++x)
    for (int y = 0; y <= 2; ++y) suspicious.Set(x, y);
  part.Set(suspicious, kClassifiedWidth, kClassifiedHeight);
  const ExpectedPicture& expected = background_->Expect(everything, {});
  classifier_.Classify(expected, image.view(), {}, everything);
  const Silhouette whole = classifier_.foreground();
  classifier_.Classify(expected, image.view(), {}, part);
  int judged = 0;
  for (int y = 0; y < kClassifiedHeight; ++y) {
    part.ForEachJudged(y, [&](const PixelRun& run) {
      // Windows that reach beyond are taken for background.
      for (int x = run.begin; x < run.end; ++x, ++judged)
        EXPECT_EQ(whole.Test(x, y), classifier_.foreground().Test(x, y)) << x << " " << y;
    });
  }
  EXPECT_GT(judged, 4000);
  EXPECT_GT(CountSet(whole), 30 * 30 + 40 * 21 - 1);
}

}  // namespace
}  // namespace mocap
