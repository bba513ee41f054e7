#include "core/reconstruction/silhouette/distortion_thresholds.h"

#include <algorithm>

#include "core/errors.h"
#include "core/kernels/statistics.h"

namespace mocap {
namespace {

constexpr int kBlock = 256;

// Three values of each pixel of a row, or of the window around it.
using Line = std::array<std::vector<float>, 3>;

kernels::WindowRow WindowRowOf(Line& line) {
  return {line[0].data(), line[1].data(), line[2].data()};
}

// Minimum over the window around each pixel, in place.
void Erode(int radius, Image<float>& image) {
  const auto width = static_cast<std::size_t>(image.width());
  std::vector<float> line(width);
  for (int y = 0; y < image.height(); ++y) {
    float* const row = image.row(y);
    std::copy_n(row, width, line.data());
    for (std::size_t k = 1; k <= std::min<std::size_t>(radius, width - 1); ++k) {
      kernels::TakeLesser(&line[k], width - k, row);
      kernels::TakeLesser(line.data(), width - k, row + k);
    }
  }
  // Original rows, for as long as they are needed.
  std::vector<std::vector<float>> above(static_cast<std::size_t>(radius) + 1);
  for (int y = 0; y < image.height(); ++y) {
    float* const row = image.row(y);
    above[static_cast<std::size_t>(y % (radius + 1))].assign(row, row + width);
    for (int k = 1; k <= radius; ++k) {
      if (y + k < image.height()) kernels::TakeLesser(image.row(y + k), width, row);
      if (y - k >= 0)
        kernels::TakeLesser(above[static_cast<std::size_t>((y - k) % (radius + 1))].data(), width,
                            row);
    }
  }
}

}  // namespace

void DistortionHistograms::Histogram::Add(const float* values, int count) {
  std::array<int, kBlock> bins;
  for (int begin = 0; begin < count; begin += kBlock) {
    const int length = std::min(kBlock, count - begin);
    kernels::FindBins(values + begin, length, kBinsPerUnit, kBins, bins.data());
    for (int i = 0; i < length; ++i) ++counts_[static_cast<std::size_t>(bins[i])];
  }
}

void DistortionHistograms::WindowHistograms::Take(const std::array<std::vector<float>, 3>& line,
                                                  int y) {
  std::copy_n(line[0].data(), cd_image.width(), cd_image.row(y));
  std::copy_n(line[1].data(), alpha_image.width(), alpha_image.row(y));
  std::copy_n(line[2].data(), roughness_image.width(), roughness_image.row(y));
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
  std::array<Line, 2> lines;
  for (Line& line : lines)
    for (auto& values : line) values.resize(static_cast<std::size_t>(width) + kernels::kBlock_px);
  const int blocks = (width + kernels::kBlock_px - 1) / kernels::kBlock_px;
  for (int y = 0; y < height; y += 2) {
    const int rows = std::min(2, height - y);
    const DistortionScan::RowPair& pair = scan_.Next();
    for (int row = 0; row < rows; ++row) {
      auto& [cd, low, high] = lines[row];
      kernels::NormalizePixels(pair.rows[row], width, cd.data(), low.data(), high.data());
      cd_.Add(cd.data(), width);
      alpha_low_.Add(low.data(), width);
      alpha_high_.Add(high.data(), width);
    }
    for (std::size_t k = 0; k < windows_.size(); ++k) {
      kernels::NormalizeWindows(pair, blocks, k, {WindowRowOf(lines[0]), WindowRowOf(lines[1])});
      for (int row = 0; row < rows; ++row) windows_[k].Take(lines[row], y + row);
    }
  }
  const auto add = [](Image<float>& image_values, int radius, Histogram& histogram) {
    Erode(radius, image_values);
    histogram.Add(image_values.row(0), static_cast<int>(image_values.pixels().size()));
  };
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    WindowHistograms& w = windows_[k];
    const int radius = kernels::kWindowRadii_px[k];
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
