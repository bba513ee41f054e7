#include "core/reconstruction/background/half_picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/errors.h"
#include "core/lanes.h"
#include "core/reconstruction/background/expected_picture.h"

namespace mocap {
namespace {

int RoundUp(int value, int step) { return (value + step - 1) / step * step; }

// Averages, rounded up.
MOCAP_INLINE std::uint8_t MeanOf(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) >> 1);
}

// Averages the bytes of two rows over pixels that are side by side, whatever their channel: byte by
// byte, for twice as many fit into a vector as of their sums.
MOCAP_VECTORIZED
void AveragePairs(const std::uint8_t* top, const std::uint8_t* bottom, int count,
                  std::uint8_t* means) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const std::uint8_t a = top[i], b = top[i + 3], c = bottom[i], d = bottom[i + 3];
    const std::uint8_t ab = MeanOf(a, b), cd = MeanOf(c, d);
    // Rounded up twice, it is one too many: first a pair's mean, then that of both.
    const std::uint8_t excess = ((a ^ b) | (c ^ d)) & (ab ^ cd) & 1;
    means[i] = static_cast<std::uint8_t>(MeanOf(ab, cd) - excess);
  }
}

using Bytes = std::uint8_t __attribute__((vector_size(16)));
constexpr int kPicked = 8;

// Picks one channel of every second one of the sixteen pixels in three vectors.
template <int c>
MOCAP_INLINE void PickChannel(const Bytes& x, const Bytes& y, const Bytes& z, std::uint8_t* to) {
  // The sixth is the last in the first two vectors, or the first in the third.
  constexpr bool kHasSixth = 30 + c < 32;
  const Bytes xy =
      __builtin_shufflevector(x, y, c, 6 + c, 12 + c, 18 + c, 24 + c, kHasSixth ? 30 + c : -1, -1,
                              -1, -1, -1, -1, -1, -1, -1, -1, -1);
  const Bytes xyz = __builtin_shufflevector(xy, z, 0, 1, 2, 3, 4, kHasSixth ? 5 : 16, 20 + c,
                                            26 + c, -1, -1, -1, -1, -1, -1, -1, -1);
  std::memcpy(to, &xyz, kPicked);
}

MOCAP_VECTORIZED
void PickPixels(const std::uint8_t* means, int count, std::uint8_t* b, std::uint8_t* g,
                std::uint8_t* r) {
  int i = 0;
  for (; i + kPicked <= count; i += kPicked) {
    Bytes x, y, z;
    LoadLanes(means + 6 * i, x), LoadLanes(means + 6 * i + 16, y), LoadLanes(means + 6 * i + 32, z);
    PickChannel<0>(x, y, z, b + i), PickChannel<1>(x, y, z, g + i), PickChannel<2>(x, y, z, r + i);
  }
  for (; i < count; ++i) b[i] = means[6 * i], g[i] = means[6 * i + 1], r[i] = means[6 * i + 2];
}

constexpr float kArea = HalfPicture::kTile * HalfPicture::kTile;

MOCAP_VECTORIZED
void AverageRow(const std::uint8_t* pixels, int stride, int width, std::uint16_t* columns,
                float* means) {
  for (int x = 0; x < width; ++x)
    columns[x] = static_cast<std::uint16_t>(pixels[x] + pixels[stride + x] +
                                            pixels[2 * stride + x] + pixels[3 * stride + x]);
  for (int i = 0; i < width / HalfPicture::kTile; ++i)
    means[i] = static_cast<float>(columns[4 * i] + columns[4 * i + 1] + columns[4 * i + 2] +
                                  columns[4 * i + 3]) /
               kArea;
}

MOCAP_VECTORIZED
void AverageVariances(const float* variance, const std::uint8_t* slope, int width, float* columns,
                      float* mean_variance, float* mean_slope_sq) {
  for (int x = 0; x < width; ++x)
    columns[x] =
        variance[x] + variance[width + x] + variance[2 * width + x] + variance[3 * width + x];
  for (int i = 0; i < width / HalfPicture::kTile; ++i)
    mean_variance[i] =
        (columns[4 * i] + columns[4 * i + 1] + columns[4 * i + 2] + columns[4 * i + 3]) / kArea;
  for (int x = 0; x < width; ++x) {
    columns[x] = 0;
    for (int y = 0; y < HalfPicture::kTile; ++y)
      columns[x] += static_cast<float>(slope[y * width + x] * slope[y * width + x]);
  }
  for (int i = 0; i < width / HalfPicture::kTile; ++i)
    mean_slope_sq[i] =
        (columns[4 * i] + columns[4 * i + 1] + columns[4 * i + 2] + columns[4 * i + 3]) / kArea;
}

// Mixes pixels with their right and lower neighbours; weights are of 256.
MOCAP_VECTORIZED
void MixPixels(const std::uint8_t* top, const std::uint8_t* bottom, int count,
               const std::array<int, 4>& weights, std::uint8_t* to) {
  const auto [w0, w1, w2, w3] = weights;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    to[x] = static_cast<std::uint8_t>(
        (w0 * top[x] + w1 * top[x + 1] + w2 * bottom[x] + w3 * bottom[x + 1] + 128) >> 8);
}

constexpr int kFetchAhead = 8;

}  // namespace

HalfPicture::HalfPicture(int full_width, int full_height)
    : width(RoundUp(full_width, kTile_px) / 2), height(RoundUp(full_height, kTile_px) / 2) {
  for (auto& plane : color) plane.resize(size());
}

void AverageTiles(const HalfPicture& half, int channel, const TileRun& run,
                  std::vector<float>& tiles, std::vector<std::uint16_t>& scratch) {
  scratch.resize(std::max(scratch.size(), static_cast<std::size_t>(half.width)));
  const std::size_t first = static_cast<std::size_t>(run.row) * HalfPicture::kTile * half.width +
                            run.begin * HalfPicture::kTile;
  AverageRow(&half.color[channel][first], half.width, (run.end - run.begin) * HalfPicture::kTile,
             scratch.data(),
             &tiles[static_cast<std::size_t>(run.row) * half.tile_columns() + run.begin]);
}

ExpectedHalf::ExpectedHalf(int full_width, int full_height)
    : mean(full_width, full_height),
      variance(mean.size(), kUnknownVariance),
      slope(mean.size()),
      tile_variance(mean.tiles(), kUnknownVariance),
      tile_slope_sq(mean.tiles()),
      columns_(static_cast<std::size_t>(mean.width)) {
  for (auto& tiles : tile_mean) tiles.resize(mean.tiles());
}

void ExpectedHalf::Finish() {
  for (int row = 0; row < mean.tile_rows(); ++row) {
    for (int c = 0; c < 3; ++c) AverageTiles(mean, c, mean.RowOfTiles(row), tile_mean[c], sums_);
    const std::size_t begin = static_cast<std::size_t>(row) * HalfPicture::kTile * mean.width;
    const std::size_t tile = static_cast<std::size_t>(row) * mean.tile_columns();
    AverageVariances(&variance[begin], &slope[begin], mean.width, columns_.data(),
                     &tile_variance[tile], &tile_slope_sq[tile]);
  }
  steep.clear();
  for (std::size_t i = 0; i < mean.size(); i += kSteepStep)
    if (slope[i] >= kSteep && variance[i] < kUnknownVariance)
      steep.push_back(static_cast<std::int32_t>(i));
}

void ExpectedHalf::LearnFrom(ImageView<const Bgr> picture) {
  std::vector<std::uint8_t> scratch;
  Halve(picture, mean, scratch);
  // The padding continues the picture: its edge is no contour.
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
  slope = SlopeOf(brightness, mean.width, mean.height);
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
      MixPixels(&from.mean.color[c][top], &from.mean.color[c][top + width], last - first, weights,
                &mean.color[c][to]);
    const std::size_t nearest = top + (a > 0.5f ? 1 : 0) + (b > 0.5f ? width : 0);
    std::copy_n(&from.variance[nearest], last - first, &variance[to]);
    std::copy_n(&from.slope[nearest], last - first, &slope[to]);
  }
  usual_distance = from.usual_distance;
  usual_shift_px = from.usual_shift_px;
}

void Halve(ImageView<const Bgr> image, HalfPicture& half, std::vector<std::uint8_t>& scratch) {
  for (int row = 0; row < half.tile_rows(); ++row)
    Halve(image, half.RowOfTiles(row), half, scratch);
}

void Halve(ImageView<const Bgr> image, const TileRun& run, HalfPicture& half,
           std::vector<std::uint8_t>& scratch) {
  MOCAP_CHECK(RoundUp(image.width(), HalfPicture::kTile_px) == 2 * half.width &&
              RoundUp(image.height(), HalfPicture::kTile_px) == 2 * half.height);
  const int first = run.begin * HalfPicture::kTile;
  const int columns = std::min(run.end * HalfPicture::kTile, image.width() / 2) - first;
  const int last_row = std::min((run.row + 1) * HalfPicture::kTile, image.height() / 2);
  scratch.resize(std::max(scratch.size(), static_cast<std::size_t>(6) * columns));
  for (int y = run.row * HalfPicture::kTile; y < last_row; ++y) {
    for (const int row : {2 * y, 2 * y + 1})
      FetchPixels(image, row + kFetchAhead, 2 * first, 2 * (first + columns));
    AveragePairs(&image.row(2 * y)[2 * first].b, &image.row(2 * y + 1)[2 * first].b,
                 6 * columns - 3, scratch.data());
    const std::size_t to = static_cast<std::size_t>(y) * half.width + first;
    PickPixels(scratch.data(), columns, &half.color[0][to], &half.color[1][to], &half.color[2][to]);
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
