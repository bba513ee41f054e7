#include "core/reconstruction/empty_room/steady_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/errors.h"
#include "core/quantile.h"

namespace mocap {
namespace {

constexpr int kWindow = 2 * kSmoothed_px + 1;
/// Near black and near white, ratios mean nothing [grey levels].
constexpr int kDarkestLit = 16, kBrightestLit = 250;
/// A part of the pixels is enough to measure the light. Of these, those that differ from the median
/// by more than this share show somebody, or a shadow.
constexpr std::size_t kLightStep = 13;
constexpr double kSameLight = 0.03;

std::array<int, 3> ChannelsOf(const Bgr& color) { return {color.b, color.g, color.r}; }

using RowSums = std::vector<std::array<int, 3>>;

/// Adds a row, or subtracts it again.
void AddRow(const Bgr* row, int times, RowSums& sums) {
  for (std::size_t x = 0; x < sums.size(); ++x) {
    sums[x][0] += times * row[x].b;
    sums[x][1] += times * row[x].g;
    sums[x][2] += times * row[x].r;
  }
}

/// Averages columns of kWindow pixels over as many columns; pixels at the edge are repeated.
void AverageRow(const RowSums& columns, Bgr* out) {
  const int width = static_cast<int>(columns.size());
  const auto at = [&](int x) { return columns[std::clamp(x, 0, width - 1)]; };
  constexpr int kPixels = kWindow * kWindow;
  std::array<int, 3> sum{};
  for (int x = -kSmoothed_px; x <= kSmoothed_px; ++x)
    for (int c = 0; c < 3; ++c) sum[c] += at(x)[c];
  for (int x = 0; x < width; ++x) {
    const auto mean = [&](int c) {
      return static_cast<std::uint8_t>((sum[c] + kPixels / 2) / kPixels);
    };
    out[x] = {mean(0), mean(1), mean(2)};
    for (int c = 0; c < 3; ++c) sum[c] += at(x + kSmoothed_px + 1)[c] - at(x - kSmoothed_px)[c];
  }
}

}  // namespace

Image<Bgr> InLight(const Image<Bgr>& picture, const LightGain& gain) {
  std::array<std::array<std::uint8_t, 256>, 3> lit;
  for (int c = 0; c < 3; ++c) {
    for (int value = 0; value < 256; ++value)
      lit[c][value] = static_cast<std::uint8_t>(std::min(std::lround(value * gain[c]), 255L));
  }
  Image<Bgr> changed = picture;
  for (Bgr& pixel : changed.pixels()) pixel = {lit[0][pixel.b], lit[1][pixel.g], lit[2][pixel.r]};
  return changed;
}

LightGain LightBetween(const Image<Bgr>& before, const Image<Bgr>& now) {
  MOCAP_CHECK(before.width() == now.width() && before.height() == now.height());
  LightGain light = {1, 1, 1};
  for (int c = 0; c < 3; ++c) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < now.pixels().size(); i += kLightStep) {
      const int a = ChannelsOf(before.pixels()[i])[c], b = ChannelsOf(now.pixels()[i])[c];
      if (std::min(a, b) >= kDarkestLit && std::max(a, b) <= kBrightestLit)
        ratios.push_back(static_cast<double>(b) / a);
    }
    if (ratios.empty()) continue;
    const double median = MedianOf(ratios);
    std::erase_if(ratios, [&](double ratio) { return std::abs(ratio / median - 1) > kSameLight; });
    double sum = 0;
    for (const double ratio : ratios) sum += ratio;
    light[c] = sum / static_cast<double>(ratios.size());
  }
  return light;
}

Image<Bgr> Smooth(ImageView<const Bgr> picture) {
  Image<Bgr> smooth(picture.width(), picture.height());
  const auto row = [&](int y) { return picture.row(std::clamp(y, 0, picture.height() - 1)); };
  RowSums columns(static_cast<std::size_t>(picture.width()));
  for (int y = -kSmoothed_px; y <= kSmoothed_px; ++y) AddRow(row(y), 1, columns);
  for (int y = 0; y < picture.height(); ++y) {
    AverageRow(columns, smooth.row(y));
    AddRow(row(y + kSmoothed_px + 1), 1, columns);
    AddRow(row(y - kSmoothed_px), -1, columns);
  }
  return smooth;
}

SteadyPicture PictureSteadier::Steady(ImageView<const Bgr> picture) {
  SteadyPicture steady{Smooth(picture), {1, 1, 1}};
  if (first_.empty()) {
    first_ = steady.color;
    return steady;
  }
  steady.light = LightBetween(first_, steady.color);
  steady.color =
      InLight(steady.color, {1 / steady.light[0], 1 / steady.light[1], 1 / steady.light[2]});
  return steady;
}

}  // namespace mocap
