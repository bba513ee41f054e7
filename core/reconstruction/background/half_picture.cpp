#include "core/reconstruction/background/half_picture.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/kernels/halving.h"
#include "core/kernels/mixing.h"
#include "core/reconstruction/background/expected_picture.h"

namespace mocap {
namespace {

int RoundUp(int value, int step) { return (value + step - 1) / step * step; }

constexpr int kTile = HalfPicture::kTile;
constexpr int kTileRows = HalfPicture::kTileRows;
constexpr int kRowStep_px = HalfPicture::kRowStep_px;

Bgr MeanOfFour(ImageView<const Bgr> image, int x, int y) {
  const Bgr &top = image(x, y), &bottom = image(x, y + 1);
  return {kernels::MeanOfFour(&top.b, &bottom.b), kernels::MeanOfFour(&top.g, &bottom.g),
          kernels::MeanOfFour(&top.r, &bottom.r)};
}

// Halves a tile, which may extend beyond the picture.
void HalveTile(ImageView<const Bgr> image, int row, int column, HalfPicture& half) {
  std::array<int, 3> sums{};
  for (int y = row * kTileRows; y < (row + 1) * kTileRows; ++y) {
    for (int x = column * kTile; x < (column + 1) * kTile; ++x) {
      if (y * kRowStep_px + 1 >= image.height() || 2 * x + 1 >= image.width()) continue;
      const Bgr mean = MeanOfFour(image, 2 * x, y * kRowStep_px);
      const std::array<std::uint8_t, 3> color = {mean.b, mean.g, mean.r};
      for (int c = 0; c < 3; ++c) {
        half.color[c][static_cast<std::size_t>(y) * half.width + x] = color[c];
        sums[c] += color[c];
      }
    }
  }
  for (int c = 0; c < 3; ++c)
    half.tile_mean[c][static_cast<std::size_t>(row) * half.tile_columns() + column] =
        static_cast<float>(sums[c]) / kernels::kTilePixels;
}

}  // namespace

HalfPicture::HalfPicture(int full_width, int full_height)
    : width(RoundUp(full_width, kTile_px) / 2),
      height(RoundUp(full_height, kTile_px) / kRowStep_px) {
  for (auto& plane : color) plane.resize(size());
  for (auto& plane : tile_mean) plane.resize(tiles());
}

void HalfPicture::Resize(int full_width, int full_height) {
  if (2 * width != RoundUp(full_width, kTile_px) ||
      kRowStep_px * height != RoundUp(full_height, kTile_px))
    *this = HalfPicture(full_width, full_height);
}

ExpectedHalf::ExpectedHalf(int full_width, int full_height)
    : mean(full_width, full_height),
      variance(mean.size(), kUnknownVariance),
      slope(mean.size()),
      tile_variance(mean.tiles(), kUnknownVariance),
      tile_slope_sq(mean.tiles()),
      sums_(static_cast<std::size_t>(mean.width)),
      columns_(static_cast<std::size_t>(mean.width)) {}

void ExpectedHalf::Finish() {
  for (int row = 0; row < mean.tile_rows(); ++row) {
    const std::size_t begin = mean.FirstPixelOf(row, 0);
    const std::size_t tile = static_cast<std::size_t>(row) * mean.tile_columns();
    for (int c = 0; c < 3; ++c)
      kernels::AverageTiles(&mean.color[c][begin], mean.width, sums_.data(),
                            &mean.tile_mean[c][tile]);
    kernels::AverageVariances(&variance[begin], &slope[begin], mean.width, columns_.data(),
                              &tile_variance[tile], &tile_slope_sq[tile]);
  }
  steep.clear();
  for (std::size_t i = 0; i < mean.size(); i += kSteepStep)
    if (slope[i] >= kSteep && variance[i] < kUnknownVariance)
      steep.push_back(static_cast<std::int32_t>(i));
}

WholeHalf::WholeHalf(ImageView<const Bgr> picture)
    : color(picture.width() / 2, picture.height() / 2) {
  std::vector<float> brightness;
  for (int y = 0; y < color.height(); ++y) {
    for (int x = 0; x < color.width(); ++x) {
      const Bgr p = color(x, y) = MeanOfFour(picture, 2 * x, 2 * y);
      brightness.push_back(static_cast<float>(p.b + p.g + p.r) / 3);
    }
  }
  slope = SlopeOf(brightness, color.width(), color.height());
}

void ExpectedHalf::LearnFrom(ImageView<const Bgr> picture) {
  Halve(picture, mean);
  const WholeHalf whole(picture);
  constexpr int kStep = kRowStep_px / 2;
  for (int y = 0; kStep * y < whole.color.height(); ++y)
    std::copy_n(&whole.slope[static_cast<std::size_t>(kStep) * y * whole.color.width()],
                whole.color.width(), &slope[static_cast<std::size_t>(y) * mean.width]);
}

void ExpectedHalf::Displace(const ExpectedHalf& from, const Displacement& displacement) {
  const int width = mean.width;
  const float right = -displacement.x_px / 2, down = -displacement.y_px / kRowStep_px;
  const float dx = std::floor(right), dy = std::floor(down);
  const float a = right - dx, b = down - dy;
  const int shift = static_cast<int>(dx);
  std::array<int, 4> weights = {0, static_cast<int>(256 * a * (1 - b)),
                                static_cast<int>(256 * (1 - a) * b), static_cast<int>(256 * a * b)};
  weights[0] = 256 - weights[1] - weights[2] - weights[3];
  const int first = std::clamp(-shift, 0, width);
  const int last = std::clamp(width - 1 - shift, first, width);
  std::fill(variance.begin(), variance.end(), kUnknownVariance);
  for (int y = 0; y < mean.height; ++y) {
    const int row = y + static_cast<int>(dy);
    if (row < 0 || row + 1 >= mean.height) continue;
    const std::size_t to = static_cast<std::size_t>(y) * width + first;
    const std::size_t top = static_cast<std::size_t>(row) * width + first + shift;
    for (int c = 0; c < 3; ++c)
      kernels::MixByteNeighbours(&from.mean.color[c][top], &from.mean.color[c][top + width],
                                 last - first, weights, &mean.color[c][to]);
    const std::size_t nearest = top + (a > 0.5f ? 1 : 0) + (b > 0.5f ? width : 0);
    std::copy_n(&from.variance[nearest], last - first, &variance[to]);
    std::copy_n(&from.slope[nearest], last - first, &slope[to]);
  }
  usual_distance = from.usual_distance;
  usual_shift_px = from.usual_shift_px;
}

void Halve(ImageView<const Bgr> image, HalfPicture& half) {
  constexpr int kTile_px = HalfPicture::kTile_px;
  MOCAP_CHECK(RoundUp(image.width(), kTile_px) == 2 * half.width &&
              RoundUp(image.height(), kTile_px) == kRowStep_px * half.height);
  const int whole_columns = image.width() / kTile_px >= 2 ? image.width() / kTile_px : 0;
  for (int row = 0; row < half.tile_rows(); ++row) {
    const bool is_whole = row < image.height() / kTile_px && whole_columns > 0;
    if (is_whole) {
      const std::size_t pixel = half.FirstPixelOf(row, 0);
      kernels::HalvedTiles to{{}, {}, half.width};
      for (int c = 0; c < 3; ++c) {
        to.color[c] = &half.color[c][pixel];
        to.tile_mean[c] = &half.tile_mean[c][static_cast<std::size_t>(row) * half.tile_columns()];
      }
      kernels::HalveTiles(&image(0, row * kTile_px).b,
                          image.stride() * static_cast<std::ptrdiff_t>(sizeof(Bgr)), whole_columns,
                          to);
    }
    for (int column = is_whole ? whole_columns : 0; column < half.tile_columns(); ++column)
      HalveTile(image, row, column, half);
  }
}

std::vector<std::uint8_t> SlopeOf(const std::vector<float>& brightness, int width, int height) {
  std::vector<std::uint8_t> slope(brightness.size());
  const auto at = [&](int x, int y) {
    return brightness[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width +
                      std::clamp(x, 0, width - 1)];
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float here = at(x, y);
      const float dx = std::max(std::abs(at(x + 1, y) - here), std::abs(at(x - 1, y) - here));
      const float dy = std::max(std::abs(at(x, y + 1) - here), std::abs(at(x, y - 1) - here));
      slope[static_cast<std::size_t>(y) * width + x] =
          static_cast<std::uint8_t>(std::min(std::hypot(dx, dy), 255.0f));
    }
  }
  return slope;
}

}  // namespace mocap
