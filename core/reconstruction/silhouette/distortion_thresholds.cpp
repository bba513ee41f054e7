#include "core/reconstruction/silhouette/distortion_thresholds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"
#include "core/kernels/statistics.h"

namespace mocap {
namespace {

constexpr int kBlock = 256;

// Quantile of the standard normal distribution, by bisection.
double NormalQuantile(double rate) {
  double low = -10, high = 10;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(-middle / std::numbers::sqrt2) / 2 < rate ? low : high) = middle;
  }
  return low;
}

// Quantile of the chi-square distribution (Wilson, Hilferty 1931).
double ChiSquareQuantile(int freedom, double rate) {
  const double variance = 2.0 / (9 * freedom);
  return freedom * std::pow(1 - variance + NormalQuantile(rate) * std::sqrt(variance), 3);
}

void Raise(float least, float& threshold) { threshold = std::max(threshold, least); }

// Minimum over the window around each pixel, in place.
void Erode(int radius, int width, int height, Image<float>& image) {
  const auto count = static_cast<std::size_t>(width);
  Image<float> from = image;
  for (int y = 0; y < height; ++y) {
    for (std::size_t k = 1; k <= std::min<std::size_t>(radius, count - 1); ++k) {
      kernels::TakeLesser(from.row(y) + k, count - k, image.row(y));
      kernels::TakeLesser(from.row(y), count - k, image.row(y) + k);
    }
  }
  from = image;
  for (int y = 0; y < height; ++y)
    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
      kernels::TakeLesser(from.row(v), count, image.row(y));
}

}  // namespace

DistortionThresholds IndependentNoise(double detection_rate) {
  // A colour has two dimensions beside brightness, and a plane through a window has three. The
  // windows with a pixel at one of their four corners hardly overlap, and the least of them counts.
  constexpr int kPlane = 3, kCorners = 4;
  const double rate = 1 - std::pow(1 - detection_rate, 1.0 / kCorners);
  const double color = std::sqrt(-2 * std::log(1 - rate));
  const double brightness = NormalQuantile((1 + rate) / 2);
  DistortionThresholds thresholds;
  thresholds.cd = static_cast<float>(std::sqrt(-2 * std::log(1 - detection_rate)));
  thresholds.alpha_low = static_cast<float>(-NormalQuantile(detection_rate));
  for (std::size_t k = 0; k < kernels::kWindows; ++k) {
    const int side = 2 * kernels::kWindowRadii_px[k] + 1, area = side * side;
    const double squares = ChiSquareQuantile(area - kPlane, rate);
    thresholds.windows[k] = {static_cast<float>(color / side),
                             static_cast<float>(brightness / side),
                             static_cast<float>(std::sqrt(squares / area))};
  }
  return thresholds;
}

void DistortionHistograms::Histogram::Add(const float* values, int count) {
  std::array<int, kBlock> bins;
  for (int begin = 0; begin < count; begin += kBlock) {
    const int length = std::min(kBlock, count - begin);
    kernels::FindBins(values + begin, length, kBinsPerUnit, kBins, bins.data());
    for (int i = 0; i < length; ++i) ++counts_[static_cast<std::size_t>(bins[i])];
  }
}

float DistortionHistograms::Histogram::Quantile(double rate) const {
  std::int64_t total = 0;
  for (const std::int64_t count : counts_) total += count;
  const double wanted = rate * static_cast<double>(total);
  std::int64_t below = 0;
  int bin = 0;
  while (bin < kBins - 1) {
    below += counts_[static_cast<std::size_t>(bin++)];
    if (static_cast<double>(below) >= wanted) break;
  }
  return static_cast<float>(bin) / kBinsPerUnit;
}

void DistortionHistograms::Add(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const std::array<float, 3>& gain) {
  const int width = image.width(), height = image.height();
  // Whole blocks of two rows at once are written.
  const int blocks = (width + kernels::kBlock_px - 1) / kernels::kBlock_px;
  for (WindowValues& w : windows_)
    for (auto* values : {&w.cd_image, &w.alpha_image, &w.roughness_image})
      *values = Image<float>(blocks * kernels::kBlock_px, height + 1);
  everything_.SetAll(width, height);
  scan_.Begin(expected, image, gain, everything_);
  std::vector<float> cd(width), darker(width);
  for (int y = 0; y < height; y += 2) {
    const DistortionScan::RowPair& pair = scan_.Next();
    for (int row = 0; row < std::min(2, height - y); ++row) {
      kernels::NormalizePixels(pair.rows[row], width, cd.data(), darker.data());
      cd_.Add(cd.data(), width);
      darker_.Add(darker.data(), width);
    }
    for (std::size_t k = 0; k < windows_.size(); ++k) {
      WindowValues& w = windows_[k];
      const auto row_of = [&w](int v) {
        return kernels::WindowRow{w.cd_image.row(v), w.alpha_image.row(v),
                                  w.roughness_image.row(v)};
      };
      kernels::NormalizeWindows(pair, blocks, k, {row_of(y), row_of(y + 1)});
    }
  }
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    const auto add = [&](Image<float>& values, Histogram& histogram) {
      Erode(kernels::kWindowRadii_px[k], width, height, values);
      for (int y = 0; y < height; ++y) histogram.Add(values.row(y), width);
    };
    WindowValues& w = windows_[k];
    add(w.cd_image, w.cd);
    add(w.alpha_image, w.alpha);
    add(w.roughness_image, w.roughness);
  }
}

DistortionThresholds DistortionHistograms::At(double detection_rate) const {
  MOCAP_CHECK(detection_rate >= 0.5 && detection_rate < 1);
  DistortionThresholds thresholds = IndependentNoise(detection_rate);
  Raise(cd_.Quantile(detection_rate), thresholds.cd);
  thresholds.alpha_low = std::min(thresholds.alpha_low, -darker_.Quantile(detection_rate));
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    DistortionThresholds::Window& window = thresholds.windows[k];
    Raise(windows_[k].cd.Quantile(detection_rate), window.cd);
    Raise(windows_[k].alpha.Quantile(detection_rate), window.alpha);
    Raise(windows_[k].roughness.Quantile(detection_rate), window.roughness);
  }
  return thresholds;
}

}  // namespace mocap
