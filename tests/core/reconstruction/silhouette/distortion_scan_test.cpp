#include "core/reconstruction/silhouette/distortion_scan.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/kernels/windows_reference.h"

namespace mocap {
namespace {

using kernels::kWindows;
using kernels::reference::WindowDistortion;

// Of the windows around a pixel of one of two rows.
std::array<WindowDistortion, kWindows> WindowsAround(int x, int row,
                                                     const DistortionScan::RowPair& pair) {
  std::array<WindowDistortion, kWindows> windows;
  for (std::size_t k = 0; k < kWindows; ++k)
    windows[k] = kernels::reference::MeasureWindow(pair, row, x, k);
  return windows;
}

TEST(DistortionScan, GivesWhatTheFormulasOfOnePixelGive) {
  ExpectedPicture expected(1, 1);
  expected.SetPixel(0, {100, 80, 60}, {2, 4, 3});
  expected.Weigh(0, 0, 0, 1);
  Image<Bgr> image(1, 1, {90, 85, 50});
  RegionOfInterest everything;
  everything.SetAll(image.width(), image.height());
  DistortionScan scan;
  scan.Begin(expected, image.view(), {1, 1, 1}, everything);
  const DistortionScan::RowPair& pair = scan.Next();
  const DistortionScan::Row& row = pair.rows[0];
  // z = (45, 21.25, 16.667), m = (50, 20, 20): α = z·m / m·m.
  const double alpha = (45 * 50 + 21.25 * 20 + 50.0 / 3 * 20) / (2500 + 400 + 400);
  const double cd_sq = std::pow(45 - alpha * 50, 2) + std::pow(21.25 - alpha * 20, 2) +
                       std::pow(50.0 / 3 - alpha * 20, 2);
  EXPECT_NEAR(row.alpha_shift[0], alpha - 1, 1e-5);
  EXPECT_NEAR(row.cd_sq[0], cd_sq, 1e-3);
  EXPECT_NEAR(row.alpha_weight[0], std::sqrt(3300.0), 1e-3);
  for (const WindowDistortion& window : WindowsAround(0, 0, pair)) {
    EXPECT_NEAR(window.alpha_shift, alpha - 1, 1e-5);
    EXPECT_NEAR(window.cd_sq, cd_sq, 1e-2);
    EXPECT_NEAR(window.roughness_sq, 0, 1e-2);
  }
}

TEST(DistortionScan, ABrightnessThatChangesAlongASlopeIsNotRough) {
  ExpectedPicture expected(40, 30);
  Image<Bgr> image(40, 30);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      expected.SetPixel(static_cast<std::size_t>(y * 40 + x), {100, 100, 100}, {1, 1, 1});
      const auto value = static_cast<std::uint8_t>(60 + x + 2 * y);
      image(x, y) = {value, value, value};
    }
  }
  for (int y = 0; y < 30; ++y) expected.Weigh(0, y, 0, 40);
  image(30, 20) = {255, 255, 255};
  RegionOfInterest everything;
  everything.SetAll(image.width(), image.height());
  DistortionScan scan;
  scan.Begin(expected, image.view(), {1, 1, 1}, everything);
  DistortionScan::RowPair pair;
  for (int y = 0; y < 30; ++y) {
    if (y % 2 == 0) pair = scan.Next();
    for (std::size_t k = 0; k < kWindows; ++k) {
      const int r = kernels::kWindowRadii_px[k];
      for (int x = r; x < 40 - r && y >= r && y < 30 - r; ++x) {
        if (std::abs(x - 30) <= r && std::abs(y - 20) <= r) {
          EXPECT_GT(WindowsAround(x, y % 2, pair)[k].roughness_sq, 100);
        } else {
          EXPECT_NEAR(WindowsAround(x, y % 2, pair)[k].roughness_sq, 0, 0.05);
          EXPECT_NEAR(WindowsAround(x, y % 2, pair)[k].alpha_shift, (x + 2 * y) / 100.0 - 0.4,
                      1e-4);
        }
      }
    }
  }
}

}  // namespace
}  // namespace mocap
