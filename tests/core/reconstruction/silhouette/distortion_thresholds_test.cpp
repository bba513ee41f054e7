#include "core/reconstruction/silhouette/distortion_thresholds.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mocap
