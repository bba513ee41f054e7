#include "core/reconstruction/silhouette/distortion_thresholds.h"

#include <gtest/gtest.h>

#include <array>

#include "core/reconstruction/silhouette/coarse_scan.h"
#include "tests/core/reconstruction/synthetic_pictures.h"

namespace mocap {
namespace {

constexpr int kThresholdWidth = 160;
constexpr int kThresholdHeight = 120;

TEST(DistortionHistograms, ThresholdsKeepTheWantedRateOnPicturesThatWereNotLearned) {
  NoisySensor sensor(2.0f, 13);
  const ExactPicture studio = EmptyStudio(kThresholdWidth, kThresholdHeight);
  for (const double rate : {0.99, 0.999}) {
    SCOPED_TRACE(rate);
    const auto background = LearnFixedBackground(TakeBackground(studio, 30, sensor), rate);
    const DistortionThresholds& t = background->thresholds();
    RegionOfInterest everything;
    everything.SetAll(kThresholdWidth, kThresholdHeight);
    DistortionScan scan;
    CoarseScan coarse;
    int cd = 0, low = 0, high = 0, all = 0;
    for (int i = 0; i < 10; ++i) {
      const Image<Bgr> image = sensor.Take(studio);
      coarse.Compare(background->CoarsePass({}, {}), image.view());
      scan.Begin(background->Expect(everything, {}), image.view(), coarse.conditions().gain,
                 everything);
      static_assert(kThresholdHeight % 2 == 0);
      for (int y = 0; y < kThresholdHeight; y += 2) {
        for (const DistortionScan::Row& row : scan.Next().rows) {
          for (int x = 0; x < kThresholdWidth; ++x) {
            cd += row.cd_sq[x] > t.cd * t.cd;
            const float alpha = row.alpha_shift[x] * row.alpha_weight[x];
            low += alpha < t.alpha_low;
            // Noise makes pixels brighter as often as darker.
            high += alpha > -t.alpha_low;
            ++all;
          }
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

TEST(IndependentNoise, HasTheQuantilesOfStatisticalTables) {
  const DistortionThresholds t = IndependentNoise(0.9999);
  EXPECT_NEAR(t.cd * t.cd, 18.42, 0.01);    // Chi-square, 2 degrees of freedom.
  EXPECT_NEAR(t.alpha_low, -3.719, 0.001);  // Normal, one side.
  static_assert(kernels::kWindowRadii_px == std::array<int, 2>{2, 3});
  for (std::size_t k = 0; k < kernels::kWindows; ++k) {
    const float side = std::array<float, 2>{5, 7}[k];
    // All four windows with the pixel at a corner exceed these: each does at a rate of 0.1.
    EXPECT_NEAR(t.windows[k].cd * side, 2.146, 0.001);
    EXPECT_NEAR(t.windows[k].alpha * side, 1.645, 0.001);  // Normal, both sides.
    const float chi_square =
        std::array<float, 2>{30.81f, 58.64f}[k];  // 22 and 46 degrees of freedom.
    EXPECT_NEAR(t.windows[k].roughness * t.windows[k].roughness * side * side, chi_square,
                0.01 * chi_square);
  }
}

TEST(DistortionHistograms, APictureWithoutNoiseHasTheThresholdsOfIndependentNoise) {
  NoisySensor coded(0.01f, 15);
  const ExactPicture studio = EmptyStudio(kThresholdWidth, kThresholdHeight);
  const auto background = LearnFixedBackground(TakeBackground(studio, 10, coded), 0.999);
  const DistortionThresholds &t = background->thresholds(), least = IndependentNoise(0.999);
  EXPECT_EQ(t.cd, least.cd);
  EXPECT_EQ(t.alpha_low, least.alpha_low);
  for (std::size_t k = 0; k < kernels::kWindows; ++k) {
    EXPECT_EQ(t.windows[k].cd, least.windows[k].cd);
    EXPECT_EQ(t.windows[k].alpha, least.windows[k].alpha);
    EXPECT_EQ(t.windows[k].roughness, least.windows[k].roughness);
  }
}

}  // namespace
}  // namespace mocap
