#include "core/reconstruction/distortion_thresholds.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

// The least value within the window around each pixel, in place.
void Erode(int radius, Image<float>& image) {
  std::vector<float> line;
  const auto erode_line = [&line, radius](float* first, int count, std::ptrdiff_t step) {
    line.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) line[i] = first[i * step];
    for (int i = 0; i < count; ++i) {
      const int begin = std::max(i - radius, 0);
      const int end = std::min(i + radius + 1, count);
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

void DistortionHistograms::Add(const ExpectedPicture& expected, ImageView<const Bgr> image,
                               const std::array<float, 3>& gain) {
  const int width = image.width();
  const int height = image.height();
  for (WindowHistograms& w : windows_)
    for (auto* values : {&w.cd_image, &w.alpha_image, &w.roughness_image})
      if (values->width() != width || values->height() != height)
        *values = Image<float>(width, height);
  everything_.SetAll(width, height);
  scan_.Begin(expected, image, gain, everything_);
  for (int y = 0; y < height; ++y) {
    const DistortionScan::Row& row = scan_.Next();
    for (int x = 0; x < width; ++x) {
      const float alpha = row.alpha_shift[x] * row.alpha_weight[x];
      cd_.Add(std::sqrt(row.cd_sq[x]));
      alpha_low_.Add(-alpha);
      alpha_high_.Add(alpha);
      for (std::size_t k = 0; k < windows_.size(); ++k) {
        const DistortionScan::Windows& measured = row.windows[k];
        windows_[k].cd_image(x, y) = std::sqrt(measured.cd_sq[x]);
        windows_[k].alpha_image(x, y) = std::abs(measured.alpha_shift[x]) * row.alpha_weight[x];
        windows_[k].roughness_image(x, y) = std::sqrt(std::max(measured.roughness_sq[x], 0.0f));
      }
    }
  }
  const auto add = [](Image<float>& image_values, int radius, Histogram& histogram) {
    Erode(radius, image_values);
    for (const float value : image_values.pixels()) histogram.Add(value);
  };
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    WindowHistograms& w = windows_[k];
    const int radius = DistortionScan::kRadii_px[k];
    add(w.cd_image, radius, w.cd);
    add(w.alpha_image, radius, w.alpha);
    add(w.roughness_image, radius, w.roughness);
  }
}

DistortionThresholds DistortionHistograms::At(double detection_rate) const {
  MOCAP_CHECK(detection_rate > 0 && detection_rate < 1);
  DistortionThresholds thresholds;
  thresholds.cd = cd_.Quantile(detection_rate);
  thresholds.alpha_low = -alpha_low_.Quantile(detection_rate);
  thresholds.alpha_high = alpha_high_.Quantile(detection_rate);
  for (std::size_t k = 0; k < windows_.size(); ++k)
    thresholds.windows[k] = {windows_[k].cd.Quantile(detection_rate),
                             windows_[k].alpha.Quantile(detection_rate),
                             windows_[k].roughness.Quantile(detection_rate)};
  return thresholds;
}

}  // namespace mocap
