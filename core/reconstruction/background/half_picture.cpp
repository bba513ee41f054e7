#include "core/reconstruction/background/half_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/errors.h"
#include "core/lanes.h"
#include "core/reconstruction/background/expected_picture.h"

namespace mocap {
namespace {

int RoundUp(int value, int step) { return (value + step - 1) / step * step; }

constexpr int kTile = HalfPicture::kTile;
constexpr float kArea = kTile * kTile;

// Average, rounded up.
MOCAP_INLINE std::uint8_t MeanOf(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>((a + b + 1) >> 1);
}

// Averages a byte of two neighbouring pixels and of the two below.
MOCAP_INLINE std::uint8_t MeanOfFour(const std::uint8_t* top, const std::uint8_t* bottom) {
  const std::uint8_t a = top[0], b = top[3], c = bottom[0], d = bottom[3];
  const std::uint8_t ab = MeanOf(a, b), cd = MeanOf(c, d);
  // Rounding up twice gives one too many if a pair's mean and the mean of both are rounded.
  const std::uint8_t excess = ((a ^ b) | (c ^ d)) & (ab ^ cd) & 1;
  return static_cast<std::uint8_t>(MeanOf(ab, cd) - excess);
}

using Bytes = std::uint8_t __attribute__((vector_size(16)));
using Shorts = std::uint16_t __attribute__((vector_size(16)));

// Averages the bytes of two rows, regardless of channel. Twice as many bytes fit into a vector as
// sums of them. Compilers recognize the average of bytes only in loops.
MOCAP_INLINE void AverageBytes(const std::uint8_t* top, const std::uint8_t* bottom, Bytes& first,
                               Bytes& second) {
  alignas(32) std::array<std::uint8_t, 2 * sizeof(Bytes)> means;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < means.size(); ++i) means[i] = MeanOfFour(top + i, bottom + i);
  LoadLanes(means.data(), first), LoadLanes(means.data() + sizeof first, second);
}

MOCAP_INLINE Shorts FirstHalfOf(Bytes bytes) {
  static_assert(std::endian::native == std::endian::little);
  return reinterpret_cast<Shorts>(__builtin_shufflevector(bytes, Bytes{}, 0, 16, 1, 16, 2, 16, 3,
                                                          16, 4, 16, 5, 16, 6, 16, 7, 16));
}

// Two neighbouring tiles are halved at once.
constexpr int kStrip = 2 * kTile;

// Sums of a strip's columns, per channel.
using Columns = std::array<Shorts, 3>;

// Halves two rows of the picture to eight pixels, and adds these to the column sums.
MOCAP_INLINE void HalveStrip(const std::uint8_t* top, const std::uint8_t* bottom, std::uint8_t* b,
                             std::uint8_t* g, std::uint8_t* r, Columns& columns) {
  // The last vector ends with the last pixel: nothing is read beyond the picture.
  constexpr int kLast = 6 * kStrip - 3 - 2 * static_cast<int>(sizeof(Bytes));
  Bytes x, y, z, unused;
  AverageBytes(top, bottom, x, y);
  AverageBytes(top + kLast, bottom + kLast, unused, z);
  Bytes blue_green =
      __builtin_shufflevector(x, y, 0, 6, 12, 18, 24, 30, -1, -1, 1, 7, 13, 19, 25, 31, -1, -1);
  Bytes red =
      __builtin_shufflevector(x, y, 2, 8, 14, 20, 26, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1);
  blue_green = __builtin_shufflevector(blue_green, z, 0, 1, 2, 3, 4, 5, 23, 29, 8, 9, 10, 11, 12,
                                       13, 24, 30);
  red = __builtin_shufflevector(red, z, 0, 1, 2, 3, 4, 19, 25, 31, -1, -1, -1, -1, -1, -1, -1, -1);
  const Bytes green = __builtin_shufflevector(blue_green, blue_green, 8, 9, 10, 11, 12, 13, 14, 15,
                                              -1, -1, -1, -1, -1, -1, -1, -1);
  std::memcpy(b, &blue_green, kStrip);
  std::memcpy(g, &green, kStrip);
  std::memcpy(r, &red, kStrip);
  columns[0] += FirstHalfOf(blue_green), columns[1] += FirstHalfOf(green);
  columns[2] += FirstHalfOf(red);
}

// Destination of neighbouring halved tiles, per channel.
struct Halves {
  std::array<std::uint8_t*, 3> color;
  std::array<float*, 3> tile_mean;
  int width;  // From one row of pixels to the next.
};

// Halves two or more whole tiles.
MOCAP_VECTORIZED
void HalveTiles(const std::uint8_t* from, std::ptrdiff_t stride, int count, const Halves& to) {
  const auto [b, g, r] = to.color;
  const int width = to.width;
  // If the number of tiles is odd, the last pair overlaps the one before.
  for (int end = 2; end < count + 2; end += 2) {
    const int tile = std::min(end, count) - 2;
    Columns columns{};
#pragma GCC unroll 4
    for (int y = 0; y < kTile; ++y) {
      const std::uint8_t* const top = from + 2 * y * stride + tile * kTile * 6;
      const int i = y * width + tile * kTile;
      HalveStrip(top, top + stride, b + i, g + i, r + i, columns);
    }
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      Shorts sums = columns[c];
      sums += __builtin_shufflevector(sums, sums, 1, 0, 3, 2, 5, 4, 7, 6);
      sums += __builtin_shufflevector(sums, sums, 2, 3, 0, 1, 6, 7, 4, 5);
      to.tile_mean[c][tile] = static_cast<float>(sums[0]) / kArea;
      to.tile_mean[c][tile + 1] = static_cast<float>(sums[kTile]) / kArea;
    }
  }
}

MOCAP_VECTORIZED
void AverageRow(const std::uint8_t* pixels, int width, std::uint16_t* columns, float* means) {
  for (int x = 0; x < width; ++x)
    columns[x] = static_cast<std::uint16_t>(pixels[x] + pixels[width + x] + pixels[2 * width + x] +
                                            pixels[3 * width + x]);
  for (int i = 0; i < width / kTile; ++i)
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

// Interpolates between pixels and their right and lower neighbours; weights sum to 256.
MOCAP_VECTORIZED
void MixPixels(const std::uint8_t* top, const std::uint8_t* bottom, int count,
               const std::array<int, 4>& weights, std::uint8_t* to) {
  const auto [w0, w1, w2, w3] = weights;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    to[x] = static_cast<std::uint8_t>(
        (w0 * top[x] + w1 * top[x + 1] + w2 * bottom[x] + w3 * bottom[x + 1] + 128) >> 8);
}

// Halves a tile, which may extend beyond the picture.
void HalveTile(ImageView<const Bgr> image, int row, int column, HalfPicture& half) {
  std::array<int, 3> sums{};
  for (int y = row * kTile; y < std::min((row + 1) * kTile, image.height() / 2); ++y) {
    for (int x = column * kTile; x < std::min((column + 1) * kTile, image.width() / 2); ++x) {
      for (int c = 0; c < 3; ++c) {
        const std::uint8_t mean =
            MeanOfFour(&image(2 * x, 2 * y).b + c, &image(2 * x, 2 * y + 1).b + c);
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
      AverageRow(&mean.color[c][begin], mean.width, sums_.data(), &mean.tile_mean[c][tile]);
    AverageVariances(&variance[begin], &slope[begin], mean.width, columns_.data(),
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
      MixPixels(&from.mean.color[c][top], &from.mean.color[c][top + width], last - first, weights,
                &mean.color[c][to]);
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
    Halves to{{}, {}, half.width};
    for (int c = 0; c < 3; ++c) {
      to.color[c] = &half.color[c][pixel];
      to.tile_mean[c] = &half.tile_mean[c][tile];
    }
    HalveTiles(&image(column * kTile_px, run.row * kTile_px).b,
               image.stride() * static_cast<std::ptrdiff_t>(sizeof(Bgr)), whole_columns - column,
               to);
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
