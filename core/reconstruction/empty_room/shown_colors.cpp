#include "core/reconstruction/empty_room/shown_colors.h"

#include <algorithm>

#include "core/errors.h"

namespace mocap {
namespace {

/// Later pictures count as this part of a mean, so that it follows slow changes of light.
constexpr int kMostWeights = 64;

std::uint8_t MixOf(std::uint8_t a, int a_count, std::uint8_t b, int b_count) {
  const int sum = a_count + b_count;
  return static_cast<std::uint8_t>((a * a_count + b * b_count + sum / 2) / sum);
}

void Merge(const ShownColors::Color& from, ShownColors::Color& to) {
  to.mean = {MixOf(to.mean.b, to.pictures, from.mean.b, from.pictures),
             MixOf(to.mean.g, to.pictures, from.mean.g, from.pictures),
             MixOf(to.mean.r, to.pictures, from.mean.r, from.pictures)};
  to.pictures += from.pictures;
}

}  // namespace

Bgr ShownColors::Sum::Mean() const {
  const auto rounded = [](std::uint16_t value) {
    return static_cast<std::uint8_t>(std::min((value + 128) >> 8, 255));
  };
  return {rounded(mean[0]), rounded(mean[1]), rounded(mean[2])};
}

void ShownColors::Sum::Add(const Bgr& color) {
  const int weight = std::min(++count, std::uint16_t{kMostWeights});
  const std::array<int, 3> values = {color.b, color.g, color.r};
  for (int c = 0; c < 3; ++c) {
    mean[c] = static_cast<std::uint16_t>(mean[c] + (values[c] * 256 - mean[c]) / weight);
  }
}

ShownColors::ShownColors(int width, int height, const GreyTolerance& tolerance)
    : width_(width),
      height_(height),
      tolerance_(tolerance),
      sums_(static_cast<std::size_t>(width) * height) {}

void ShownColors::Add(ImageView<const Bgr> picture) {
  MOCAP_CHECK(picture.width() == width_ && picture.height() == height_);
  for (int y = 0; y < height_; ++y) {
    const Bgr* const row = picture.row(y);
    std::array<Sum, kColors>* const sums = &sums_[static_cast<std::size_t>(y) * width_];
    for (int x = 0; x < width_; ++x) {
      Sum* rarest = &sums[x][0];
      Sum* same = nullptr;
      for (Sum& sum : sums[x]) {
        const bool is_same = sum.count > 0 && tolerance_.Accepts(sum.Mean(), row[x]);
        if (is_same && (!same || sum.count > same->count)) same = &sum;
        if (sum.count < rarest->count) rarest = &sum;
      }
      if (!same) *rarest = {};
      (same ? same : rarest)->Add(row[x]);
    }
  }
  ++pictures_;
}

std::array<ShownColors::Color, ShownColors::kColors> ShownColors::At(std::size_t pixel) const {
  std::array<Color, kColors> colors;
  for (int i = 0; i < kColors; ++i) colors[i] = {sums_[pixel][i].Mean(), sums_[pixel][i].count};
  const auto sort = [&] { std::ranges::stable_sort(colors, std::greater(), &Color::pictures); };
  sort();
  for (int i = 0; i < kColors; ++i) {
    for (int k = i + 1; k < kColors; ++k) {
      if (colors[k].pictures == 0 || !tolerance_.Accepts(colors[i].mean, colors[k].mean)) continue;
      Merge(colors[k], colors[i]);
      colors[k] = {};
    }
  }
  sort();
  return colors;
}

Image<Bgr> ShownColors::MostFrequent() const {
  Image<Bgr> colors(width_, height_);
  for (std::size_t i = 0; i < sums_.size(); ++i) colors.pixels()[i] = At(i)[0].mean;
  return colors;
}

}  // namespace mocap
