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
constexpr float kArea = kTile * kTile;

// Halves a tile, which may extend beyond the picture.
void HalveTile(ImageView<const Bgr> image, int row, int column, HalfPicture& half) {
  std::array<int, 3> sums{};
  for (int y = row * kTile; y < std::min((row + 1) * kTile, image.height() / 2); ++y) {
    for (int x = column * kTile; x < std::min((column + 1) * kTile, image.width() / 2); ++x) {
      for (int c = 0; c < 3; ++c) {
        const std::uint8_t mean =
            kernels::MeanOfFour(&image(2 * x, 2 * y).b + c, &image(2 * x, 2 * y + 1).b + c);
        half.color[c][static_cast<std::size_t>(y) * half.width + x] = mean;
        sums[c] += mean;
      }
    }
  }
  for (int c = 0; c < 3; ++c)
    half.tile_mean[c][static_cast<std::size_t>(row) * half.tile_columns() + column] =
        static_cast<float>(sums[c]) / kArea;
}

}  // namespace

HalfPicture::HalfPicture(int full_width, int full_height)
    : width(RoundUp(full_width, kTile_px) / 2), height(RoundUp(full_height, kTile_px) / 2) {
  for (auto& plane : color) plane.resize(size() + kTile);
  for (auto& plane : tile_mean) plane.resize(tiles());
}

ExpectedHalf::ExpectedHalf(int full_width, int full_height)
    : mean(full_width, full_height),
      variance(mean.size() + kTile, kUnknownVariance),
      slope(mean.size() + kTile),
      tile_variance(mean.tiles(), kUnknownVariance),
      tile_slope_sq(mean.tiles()),
      sums_(static_cast<std::size_t>(mean.width)),
      columns_(static_cast<std::size_t>(mean.width)) {}

void ExpectedHalf::Finish() {
  for (int row = 0; row < mean.tile_rows(); ++row) {
    const std::size_t begin = mean.FirstPixelOf(mean.RowOfTiles(row));
    const std::size_t tile = mean.FirstTileOf(mean.RowOfTiles(row));
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

void ExpectedHalf::LearnFrom(ImageView<const Bgr> picture) {
  Halve(picture, mean);
  // The padding repeats the picture's edge, so that the edge is no contour.
  std::vector<float> brightness(mean.size());
  for (int y = 0; y < mean.height; ++y) {
    for (int x = 0; x < mean.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(std::min(y, picture.height() / 2 - 1)) * mean.width +
          std::min(x, picture.width() / 2 - 1);
      brightness[static_cast<std::size_t>(y) * mean.width + x] =
          static_cast<float>(mean.color[0][i] + mean.color[1][i] + mean.color[2][i]) / 3;
    }
  }
  std::ranges::copy(SlopeOf(brightness, mean.width, mean.height), slope.begin());
}

void ExpectedHalf::Displace(const ExpectedHalf& from, const Displacement& displacement) {
  const int width = mean.width;
  const float dx = std::floor(-displacement.x_px / 2), dy = std::floor(-displacement.y_px / 2);
  const float a = -displacement.x_px / 2 - dx, b = -displacement.y_px / 2 - dy;
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
  for (int row = 0; row < half.tile_rows(); ++row) Halve(image, half.RowOfTiles(row), half);
}

void Halve(ImageView<const Bgr> image, const TileRun& run, HalfPicture& half) {
  constexpr int kTile_px = HalfPicture::kTile_px;
  MOCAP_CHECK(RoundUp(image.width(), kTile_px) == 2 * half.width &&
              RoundUp(image.height(), kTile_px) == 2 * half.height);
  int column = run.begin;
  const int whole_columns = std::min(run.end, image.width() / kTile_px);
  if (whole_columns - column >= 2 && run.row < image.height() / kTile_px) {
    const std::size_t pixel = half.FirstPixelOf(run), tile = half.FirstTileOf(run);
    kernels::HalvedTiles to{{}, {}, half.width};
    for (int c = 0; c < 3; ++c) {
      to.color[c] = &half.color[c][pixel];
      to.tile_mean[c] = &half.tile_mean[c][tile];
    }
    kernels::HalveTiles(&image(column * kTile_px, run.row * kTile_px).b,
                        image.stride() * static_cast<std::ptrdiff_t>(sizeof(Bgr)),
                        whole_columns - column, to);
    column = whole_columns;
  }
  for (; column < run.end; ++column) HalveTile(image, run.row, column, half);
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
