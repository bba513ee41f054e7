#include "core/reconstruction/silhouette/distortion_thresholds.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

MOCAP_VECTORIZED
void TakeLesser(const float* values, std::size_t count, float* least) {
  for (std::size_t i = 0; i < count; ++i) least[i] = std::min(least[i], values[i]);
}

constexpr int kBlock = 256;

MOCAP_VECTORIZED
void FindBins(const float* values, int count, float bins_per_unit, int bin_count, int* bins) {
  const float last = static_cast<float>(bin_count) - 1;
  for (int i = 0; i < count; ++i)
    bins[i] = static_cast<int>(std::min(std::max(values[i] * bins_per_unit, 0.0f), last));
}

// Three values of each pixel of a row.
using Line = std::array<std::vector<float>, 3>;

// Per pixel: length of the colour distance, and brightness distortion in both directions.
MOCAP_VECTORIZED
void NormalizePixels(const DistortionScan::Row& row, int count, float* cd, float* low,
                     float* high) {
  const float *const alpha_shift = row.alpha_shift, *const alpha_weight = row.alpha_weight;
  const float* const cd_sq = row.cd_sq;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    cd[x] = std::sqrt(cd_sq[x]);
    high[x] = alpha_shift[x] * alpha_weight[x];
    low[x] = -high[x];
  }
}

// Per window of one size: the same and the roughness. Writes whole blocks of pixels.
template <std::size_t window>
MOCAP_VECTORIZED void NormalizeWindows(const DistortionScan::RowPair& pair, int blocks,
                                       std::array<Line, 2>& lines) {
  for (int block = 0; block < blocks; ++block) {
    const int x = block * kFloats;
    std::array<WindowDistortions, 2> pair_d;
    std::array<Floats, 2> weights;
    for (int row = 0; row < 2; ++row) LoadLanes(pair.rows[row].alpha_weight + x, weights[row]);
    JoinLines<window>(pair.sums, block, weights, pair_d);
    for (int row = 0; row < 2; ++row) {
      WindowDistortions& d = pair_d[row];
      auto& [cd, alpha, roughness] = lines[row];
      const Floats shift = d.alpha_shift < 0 ? -d.alpha_shift : d.alpha_shift;
      Floats rough_sq = d.roughness_sq > 0 ? d.roughness_sq : Floats{};
      TakeRoots(d.cd_sq), TakeRoots(rough_sq);
      StoreLanes(d.cd_sq, &cd[x]), StoreLanes(shift * weights[row], &alpha[x]);
      StoreLanes(rough_sq, &roughness[x]);
    }
  }
}

// Minimum over the window around each pixel, in place.
void Erode(int radius, Image<float>& image) {
  const auto width = static_cast<std::size_t>(image.width());
  std::vector<float> line(width);
  for (int y = 0; y < image.height(); ++y) {
    float* const row = image.row(y);
    std::copy_n(row, width, line.data());
    for (std::size_t k = 1; k <= std::min<std::size_t>(radius, width - 1); ++k) {
      TakeLesser(&line[k], width - k, row);
      TakeLesser(line.data(), width - k, row + k);
    }
  }
  // Original rows, for as long as they are needed.
  std::vector<std::vector<float>> above(static_cast<std::size_t>(radius) + 1);
  for (int y = 0; y < image.height(); ++y) {
    float* const row = image.row(y);
    above[static_cast<std::size_t>(y % (radius + 1))].assign(row, row + width);
    for (int k = 1; k <= radius; ++k) {
      if (y + k < image.height()) TakeLesser(image.row(y + k), width, row);
      if (y - k >= 0)
        TakeLesser(above[static_cast<std::size_t>((y - k) % (radius + 1))].data(), width, row);
    }
  }
}

}  // namespace

void DistortionHistograms::Histogram::Add(const float* values, int count) {
  std::array<int, kBlock> bins;
  for (int begin = 0; begin < count; begin += kBlock) {
    const int length = std::min(kBlock, count - begin);
    FindBins(values + begin, length, kBinsPerUnit, kBins, bins.data());
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
    for (auto& values : line) values.resize(static_cast<std::size_t>(width) + kFloats);
  const int blocks = (width + kFloats - 1) / kFloats;
  for (int y = 0; y < height; y += 2) {
    const int rows = std::min(2, height - y);
    const DistortionScan::RowPair& pair = scan_.Next();
    for (int row = 0; row < rows; ++row) {
      auto& [cd, low, high] = lines[row];
      NormalizePixels(pair.rows[row], width, cd.data(), low.data(), high.data());
      cd_.Add(cd.data(), width);
      alpha_low_.Add(low.data(), width);
      alpha_high_.Add(high.data(), width);
    }
    NormalizeWindows<0>(pair, blocks, lines);
    for (int row = 0; row < rows; ++row) windows_[0].Take(lines[row], y + row);
    NormalizeWindows<1>(pair, blocks, lines);
    for (int row = 0; row < rows; ++row) windows_[1].Take(lines[row], y + row);
  }
  const auto add = [](Image<float>& image_values, int radius, Histogram& histogram) {
    Erode(radius, image_values);
    histogram.Add(image_values.row(0), static_cast<int>(image_values.pixels().size()));
  };
  for (std::size_t k = 0; k < windows_.size(); ++k) {
    WindowHistograms& w = windows_[k];
    const int radius = kWindowRadii_px[k];
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
