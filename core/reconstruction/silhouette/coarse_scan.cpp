#include "core/reconstruction/silhouette/coarse_scan.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/kernels/statistics.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/segmentation_constants.h"

namespace mocap {
namespace {

using namespace segmentation;

static_assert(Shading::kTile_px == HalfPicture::kTile_px);
constexpr float kArea = kernels::kTilePixels;
// Width of a pixel of the half picture, in pixels of the picture.
constexpr float kPixel_px = 2;

float Square(float x) { return x * x; }

float Quantile(const std::vector<float>& values, double share) {
  if (values.empty()) return 0;
  const auto count = static_cast<int>(values.size());
  return kernels::NumberAtRank(values.data(), count, static_cast<int>(share * count));
}

float Median(const std::vector<float>& values) { return Quantile(values, 0.5); }

// Returns the excess of a standard deviation over the usual one, if it is notable.
float Beyond(float value, float usual, float negligible) {
  const float beyond = std::sqrt(std::max(Square(value) - Square(kNotable * usual), 0.0f));
  return beyond < negligible ? 0 : beyond;
}

// Whether all of a tile is known. The padding is not.
bool IsKnown(const ExpectedHalf& expected, std::size_t tile) {
  return expected.tile_variance[tile] < kUnknownVariance / kArea / 2;
}

}  // namespace

void CoarseScan::Compare(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  live_.Resize(image.width(), image.height());
  MOCAP_CHECK(expected.mean.width == live_.width && expected.mean.height == live_.height);
  Halve(image, live_);
  Sample(expected);
  for (int c = 0; c < 3; ++c) conditions_.gain[c] = MeasureGain(expected, c);
  distance_ = MeasureDistance(expected);
  conditions_.drift = std::min(
      kDriftMargin * Beyond(distance_, expected.usual_distance, kNegligibleDrift), kLargestDrift);
  shift_px_ = MeasureShift(expected);
  conditions_.shift_px = Beyond(shift_px_, expected.usual_shift_px, kNegligibleShift_px);
  allowance_ = {conditions_.gain, Square(std::max(conditions_.drift, kDistanceMargin * distance_)),
                Square(kContourMargin * shift_px_ / kPixel_px)};
  MeasureTiles(expected);
  Judge(expected);
}

void CoarseScan::Sample(const ExpectedHalf& expected) {
  // Odd: few pictures have a multiple of it as width.
  const std::size_t step = live_.tiles() / kTileSamples | 1;
  samples_.clear();
  for (std::size_t i = 0; i < live_.tiles(); i += step)
    if (IsKnown(expected, i)) samples_.push_back(i);
}

float CoarseScan::MeasureGain(const ExpectedHalf& expected_half, int channel) {
  const std::vector<float>& live = live_.tile_mean[channel];
  const std::vector<float>& expected = expected_half.mean.tile_mean[channel];
  values_.clear();
  for (const std::size_t i : samples_)
    if (expected[i] >= kDarkestForGain) values_.push_back(live[i] / expected[i]);
  if (values_.empty()) return 1;
  // People and shadows lie mostly on one side of the median, so it is computed again without them.
  const float rough = Median(values_);
  std::erase_if(values_, [rough](float v) { return std::abs(v - rough) > kFlatness * rough; });
  const float fine = values_.empty() ? rough : Median(values_);
  return std::clamp(1 / std::max(fine, 1e-3f), 1 / kLargestGain, kLargestGain);
}

float CoarseScan::MeasureDistance(const ExpectedHalf& expected) {
  const auto columns = static_cast<std::size_t>(live_.tile_columns());
  values_.clear();
  for (const std::size_t i : samples_) {
    // Drift is smooth, and four tiles have less noise than one.
    const std::array<std::size_t, 4> near = {i, i + 1, i + columns, i + columns + 1};
    if ((i + 1) % columns == 0 || near[3] >= live_.tiles()) continue;
    if (!std::ranges::all_of(near, [&](std::size_t k) { return IsKnown(expected, k); })) continue;
    float length_sq = 0;
    for (int c = 0; c < 3; ++c) {
      float difference = 0;
      for (const std::size_t k : near)
        difference += conditions_.gain[c] * live_.tile_mean[c][k] - expected.mean.tile_mean[c][k];
      length_sq += Square(difference / 4);
    }
    values_.push_back(length_sq);
  }
  return std::sqrt(Quantile(values_, kUndisturbedTiles)) / kUndisturbedLength;
}

float CoarseScan::MeasureShift(const ExpectedHalf& expected) {
  if (expected.steep.size() < kFewestSteep) return 0;
  values_.clear();
  for (const std::int32_t i : expected.steep) {
    const float difference = conditions_.gain[1] * live_.color[1][i] - expected.mean.color[1][i];
    values_.push_back(std::abs(difference) / static_cast<float>(expected.slope[i]));
  }
  return std::min(kPixel_px / kUndisturbedSize * Quantile(values_, kUndisturbedContours),
                  kLargestShift_px);
}

kernels::TilePixels CoarseScan::PixelsFrom(const ExpectedHalf& expected, int row,
                                           int column) const {
  const std::size_t begin = live_.FirstPixelOf(row, column);
  kernels::TilePixels tiles{{}, {}, live_.width};
  for (int c = 0; c < 3; ++c) {
    tiles.live[c] = &live_.color[c][begin];
    tiles.expected[c] = &expected.mean.color[c][begin];
  }
  return tiles;
}

void CoarseScan::MeasureTiles(const ExpectedHalf& expected) {
  for (auto* values : {&alpha_, &tint_, &glare_, &weight_, &chi_square_})
    values->resize(live_.tiles());
  scratch_.resize(2 * static_cast<std::size_t>(live_.width));
  kernels::TileMeans means{{}, {}, expected.tile_variance.data(), expected.tile_slope_sq.data()};
  for (int c = 0; c < 3; ++c) {
    means.live[c] = live_.tile_mean[c].data();
    means.expected[c] = expected.mean.tile_mean[c].data();
  }
  kernels::MeasureTiles(means, static_cast<int>(live_.tiles()), allowance_,
                        {alpha_.data(), tint_.data(), glare_.data(), weight_.data()});
  const int columns = live_.tile_columns();
  for (int row = 0; row < live_.tile_rows(); ++row)
    kernels::MeasureChiSquares(PixelsFrom(expected, row, 0), columns, allowance_.gain,
                               &alpha_[row * columns], &weight_[row * columns], scratch_.data(),
                               &chi_square_[row * columns]);
}

void CoarseScan::Judge(const ExpectedHalf& expected) {
  values_.clear();
  for (const std::size_t i : samples_) values_.push_back(chi_square_[i]);
  const float harmless = kHarmlessChiSquare * std::max(Median(values_), kLeastChiSquare);
  suspicious_.Reset(live_.tile_columns(), live_.tile_rows());
  shades_.assign(live_.tiles(), Shading::kUnknown);
  std::size_t i = 0;
  for (int row = 0; row < live_.tile_rows(); ++row) {
    for (int column = 0; column < live_.tile_columns(); ++column, ++i) {
      if (!IsKnown(expected, i)) continue;
      shades_[i] = Shading::ShadeOf(alpha_[i] - 1);
      if (tint_[i] > kHarmlessTint || glare_[i] > kHarmlessGlare ||
          alpha_[i] < darkest_shadow_ + kDarkMargin ||
          (chi_square_[i] > harmless &&
           kernels::ChiSquareBesideSlope(PixelsFrom(expected, row, column), allowance_.gain,
                                         weight_[i]) > harmless))
        suspicious_.Set(column, row);
    }
  }
  cleaner_.DropBlobs(kFewestTiles, suspicious_);
}

}  // namespace mocap
