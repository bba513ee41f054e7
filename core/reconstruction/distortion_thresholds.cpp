#include "core/reconstruction/distortion_thresholds.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kRadius = DistortionScan::kRadius_px;

// The least value within the window around each pixel, in place.
void Erode(Image<float>& image) {
  std::vector<float> line;
  const auto erode_line = [&line](float* first, int count, std::ptrdiff_t step) {
    line.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) line[i] = first[i * step];
    for (int i = 0; i < count; ++i) {
      const int begin = std::max(i - kRadius, 0);
      const int end = std::min(i + kRadius + 1, count);
      first[i * step] = *std::min_element(line.begin() + begin, line.begin() + end);
    }
  };
  for (int y = 0; y < image.height(); ++y) erode_line(image.row(y), image.width(), 1);
  for (int x = 0; x < image.width(); ++x)
    erode_line(image.row(0) + x, image.height(), image.width());
}

}  // namespace

void DistortionHistograms::Histogram::Add(float value) {
  const int bin = static_cast<int>(std::clamp(value * kBinsPerUnit, 0.0f, kBins - 1.0f));
  ++counts_[static_cast<std::size_t>(bin)];
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

void DistortionHistograms::Add(const ExpectedPicture& expected, ImageView<const Bgr> image) {
  const int width = image.width();
  const int height = image.height();
  for (auto& window : windows_)
    if (window.width() != width || window.height() != height) window = Image<float>(width, height);
  auto& [window_cd, window_alpha, window_roughness] = windows_;
  scan_.Begin(expected, image, MeasureGain(expected, image, scratch_));
  for (int y = 0; y < height; ++y) {
    const DistortionScan::Row& row = scan_.Next();
    for (int x = 0; x < width; ++x) {
      const float alpha = row.alpha_shift[x] * row.inverse_alpha_variation[x];
      cd_.Add(std::sqrt(row.cd_sq[x]));
      alpha_low_.Add(-alpha);
      alpha_high_.Add(alpha);
      window_cd(x, y) = std::sqrt(row.window_cd_sq[x]);
      window_alpha(x, y) = std::abs(row.window_alpha_shift[x]) * row.inverse_alpha_variation[x];
      window_roughness(x, y) = std::sqrt(std::max(row.window_roughness_sq[x], 0.0f));
    }
  }
  for (auto& window : windows_) Erode(window);
  for (const float value : window_cd.pixels()) window_cd_.Add(value);
  for (const float value : window_alpha.pixels()) window_alpha_.Add(value);
  for (const float value : window_roughness.pixels()) window_roughness_.Add(value);
}

DistortionThresholds DistortionHistograms::At(double detection_rate) const {
  MOCAP_CHECK(detection_rate > 0 && detection_rate < 1);
  DistortionThresholds thresholds;
  thresholds.cd = cd_.Quantile(detection_rate);
  thresholds.alpha_low = -alpha_low_.Quantile(detection_rate);
  thresholds.alpha_high = alpha_high_.Quantile(detection_rate);
  thresholds.window_cd = window_cd_.Quantile(detection_rate);
  thresholds.window_alpha = window_alpha_.Quantile(detection_rate);
  thresholds.window_roughness = window_roughness_.Quantile(detection_rate);
  return thresholds;
}

}  // namespace mocap
