#include "core/reconstruction/coarse_scan.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/reconstruction/expected_picture.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr int kTile = HalfPicture::kTile;
constexpr float kArea = kTile * kTile;
// A pixel of the half is so many of the picture's wide.
constexpr float kPixel_px = 2;
// Every so many tiles or pixels are enough for a median; few pictures are a multiple of that wide.
constexpr std::size_t kTileStep = 7;
constexpr std::size_t kPixelStep = 7;
// A colour has a ratio to another only away from black [grey levels].
constexpr float kDarkest = 8;
constexpr float kLargestGain = 4;
// What differs more from the middle than by this share is no background.
constexpr float kFlatness = 0.06f;
// Contours steeper than this [grey levels per pixel of the half] show how far they moved.
constexpr int kSteep = 15;
constexpr std::size_t kFewestSteep = 50;
constexpr float kLargestShift_px = 1;
// Persons, shadows and what is bright from them may cover more than half: standard deviations are
// read off these shares. Of a normal distribution, they are within such a length in three
// dimensions, and such a size in one.
constexpr double kUndisturbedTiles = 0.4;
constexpr float kUndisturbedLength = 1.367f;
constexpr double kUndisturbedContours = 0.25;
constexpr float kUndisturbedSize = 0.3186f;
// Less than that much more than usual is usual, and less than that nothing [grey levels, pixels].
constexpr float kNotable = 1.5f;
constexpr float kNegligibleDrift = 0.3f;
constexpr float kNegligibleShift_px = 0.1f;
// Drift has no normal distribution: some walls change, others don't.
constexpr float kDriftMargin = 4;
constexpr float kLargestDrift = 8;
// A tile is looked at closely when it is brighter, or its colour is another, by more than so many
// variances; when its pixels differ so many times more than those of most tiles; or when it is
// nearly too dark for a shadow. So much distance and shift are part of the variance.
constexpr float kHarmlessGlare = 1.5f;
constexpr float kHarmlessTint = 1.5f;
constexpr float kHarmlessMisfit = 6;
constexpr float kLeastMisfit = 0.05f;
constexpr float kDarkMargin = 0.02f;
constexpr float kDistanceMargin = 2;
constexpr float kContourMargin = 2;
// Fewer tiles than this by themselves are noise.
constexpr int kFewestTiles = 4;

float Square(float x) { return x * x; }

float Quantile(std::vector<float>& values, double share) {
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

float Median(std::vector<float>& values) { return Quantile(values, 0.5); }

// What a standard deviation has grown by, where it has grown notably.
float Beyond(float value, float usual, float negligible) {
  const float beyond = std::sqrt(std::max(Square(value) - Square(kNotable * usual), 0.0f));
  return beyond < negligible ? 0 : beyond;
}

// Whether all of a tile is known. The padding is not.
bool IsKnown(const ExpectedHalf& expected, std::size_t tile) {
  return expected.tile_variance[tile] < kUnknownVariance / kArea / 2;
}

struct PixelRow {
  std::array<const std::uint8_t*, 3> live, expected;
  const float* variance;
  const std::uint8_t* slope;
  const float* alpha;
};

MOCAP_VECTORIZED
void AddMisfits(const PixelRow& row, int width, const std::array<float, 3>& gain, float drift_sq,
                float shift_sq, float* sums) {
  const float gain0 = gain[0], gain1 = gain[1], gain2 = gain[2];
  const float *const variance = row.variance, *const alpha = row.alpha;
  const std::uint8_t* const slopes = row.slope;
  const std::uint8_t *const l0 = row.live[0], *const l1 = row.live[1], *const l2 = row.live[2];
  const std::uint8_t *const e0 = row.expected[0], *const e1 = row.expected[1],
                            *const e2 = row.expected[2];
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float d0 = gain0 * l0[x] - alpha[x] * e0[x];
    const float d1 = gain1 * l1[x] - alpha[x] * e1[x];
    const float d2 = gain2 * l2[x] - alpha[x] * e2[x];
    const float slope = slopes[x];
    sums[x] += (d0 * d0 + d1 * d1 + d2 * d2) / (variance[x] + drift_sq + shift_sq * slope * slope);
  }
}

struct TileMeans {
  std::array<const float*, 3> live, expected;
  const float *variance, *slope_sq;
};

MOCAP_VECTORIZED
void MeasureTiles(const TileMeans& tiles, int count, const std::array<float, 3>& gain,
                  float drift_sq, float shift_sq, float* alphas, float* tints, float* glares) {
  const float gain0 = gain[0], gain1 = gain[1], gain2 = gain[2];
  const auto [l0, l1, l2] = tiles.live;
  const auto [e0, e1, e2] = tiles.expected;
  const float *const variances = tiles.variance, *const slope_sq = tiles.slope_sq;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    const float c0 = gain0 * l0[i], c1 = gain1 * l1[i], c2 = gain2 * l2[i];
    const float square = std::max(e0[i] * e0[i] + e1[i] * e1[i] + e2[i] * e2[i], 1.0f);
    const float alpha = (c0 * e0[i] + c1 * e1[i] + c2 * e2[i]) / square;
    const float d0 = c0 - alpha * e0[i], d1 = c1 - alpha * e1[i], d2 = c2 - alpha * e2[i];
    const float weight = 1 / (variances[i] + drift_sq + shift_sq * slope_sq[i]);
    const float bright = std::max(alpha - 1, 0.0f);
    alphas[i] = alpha;
    tints[i] = (d0 * d0 + d1 * d1 + d2 * d2) * weight;
    glares[i] = bright * bright * square * weight;
  }
}

}  // namespace

CoarseScan::CoarseScan(float darkest_shadow) : darkest_shadow_(darkest_shadow) {}

void CoarseScan::Compare(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  Resize(expected, image);
  Halve(image, live_, row_sums_);
  for (int c = 0; c < 3; ++c) AverageTiles(live_, c, tiles_.mean[c], row_sums_);
  for (int c = 0; c < 3; ++c) conditions_.gain[c] = MeasureGain(expected, c);
  distance_ = MeasureDistance(expected);
  conditions_.drift = std::min(
      kDriftMargin * Beyond(distance_, expected.usual_distance, kNegligibleDrift), kLargestDrift);
  drift_ = std::max(conditions_.drift, kDistanceMargin * distance_);
  shift_px_ = MeasureShift(expected);
  conditions_.shift_px = Beyond(shift_px_, expected.usual_shift_px, kNegligibleShift_px);
  MeasureTints(expected);
  MeasureMisfit(expected);
  Judge(expected);
}

void CoarseScan::Resize(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  if (image.width() != full_width_ || image.height() != full_height_) {
    full_width_ = image.width();
    full_height_ = image.height();
    live_ = HalfPicture(full_width_, full_height_);
    alphas_.resize(static_cast<std::size_t>(live_.width));
    columns_.resize(static_cast<std::size_t>(live_.width));
    for (auto* values : {&tiles_.mean[0], &tiles_.mean[1], &tiles_.mean[2], &tiles_.alpha,
                         &tiles_.tint, &tiles_.glare, &tiles_.misfit})
      values->resize(live_.tiles());
  }
  MOCAP_CHECK(expected.mean.width == live_.width && expected.mean.height == live_.height);
}

float CoarseScan::MeasureGain(const ExpectedHalf& expected_half, int channel) {
  const std::vector<float>& live = tiles_.mean[channel];
  const std::vector<float>& expected = expected_half.tile_mean[channel];
  values_.clear();
  for (std::size_t i = 0; i < live.size(); i += kTileStep)
    if (IsKnown(expected_half, i) && expected[i] >= kDarkest)
      values_.push_back(live[i] / expected[i]);
  if (values_.empty()) return 1;
  // Persons and shadows lie mostly to one side of the middle; without them it is found again.
  const float rough = Median(values_);
  std::erase_if(values_, [rough](float v) { return std::abs(v - rough) > kFlatness * rough; });
  const float fine = values_.empty() ? rough : Median(values_);
  return std::clamp(1 / std::max(fine, 1e-3f), 1 / kLargestGain, kLargestGain);
}

float CoarseScan::MeasureDistance(const ExpectedHalf& expected) {
  values_.clear();
  for (std::size_t i = 0; i < live_.tiles(); i += kTileStep) {
    if (!IsKnown(expected, i)) continue;
    float length_sq = 0;
    for (int c = 0; c < 3; ++c) {
      const float d = conditions_.gain[c] * tiles_.mean[c][i] - expected.tile_mean[c][i];
      length_sq += d * d;
    }
    values_.push_back(length_sq);
  }
  return values_.empty() ? 0 : std::sqrt(Quantile(values_, kUndisturbedTiles)) / kUndisturbedLength;
}

float CoarseScan::MeasureShift(const ExpectedHalf& expected) {
  values_.clear();
  const float gain = conditions_.gain[1];
  for (std::size_t i = 0; i < live_.size(); i += kPixelStep) {
    const int slope = expected.slope[i];
    if (slope < kSteep || expected.variance[i] >= kUnknownVariance) continue;
    const float difference = gain * live_.color[1][i] - expected.mean.color[1][i];
    values_.push_back(std::abs(difference) / static_cast<float>(slope));
  }
  if (values_.size() < kFewestSteep) return 0;
  return std::min(kPixel_px / kUndisturbedSize * Quantile(values_, kUndisturbedContours),
                  kLargestShift_px);
}

void CoarseScan::MeasureMisfit(const ExpectedHalf& expected) {
  const float drift_sq = Square(drift_);
  const float shift_sq = Square(kContourMargin * shift_px_ / kPixel_px);
  const int columns = live_.tile_columns();
  for (int row = 0; row < live_.tile_rows(); ++row) {
    const std::size_t first = static_cast<std::size_t>(row) * columns;
    for (int i = 0; i < live_.width; ++i) alphas_[i] = tiles_.alpha[first + i / kTile];
    std::fill(columns_.begin(), columns_.end(), 0.0f);
    for (int y = row * kTile; y < (row + 1) * kTile; ++y) {
      const std::size_t begin = static_cast<std::size_t>(y) * live_.width;
      PixelRow pixels{{}, {}, &expected.variance[begin], &expected.slope[begin], alphas_.data()};
      for (int c = 0; c < 3; ++c) {
        pixels.live[c] = &live_.color[c][begin];
        pixels.expected[c] = &expected.mean.color[c][begin];
      }
      AddMisfits(pixels, live_.width, conditions_.gain, drift_sq, shift_sq, columns_.data());
    }
    for (int i = 0; i < columns; ++i) {
      const float* const sums = &columns_[static_cast<std::size_t>(i) * kTile];
      tiles_.misfit[first + i] = (sums[0] + sums[1] + sums[2] + sums[3]) / kArea;
    }
  }
}

void CoarseScan::MeasureTints(const ExpectedHalf& expected) {
  TileMeans tiles{{}, {}, expected.tile_variance.data(), expected.tile_slope_sq.data()};
  for (int c = 0; c < 3; ++c) {
    tiles.live[c] = tiles_.mean[c].data();
    tiles.expected[c] = expected.tile_mean[c].data();
  }
  MeasureTiles(tiles, static_cast<int>(live_.tiles()), conditions_.gain, Square(drift_),
               Square(kContourMargin * shift_px_ / kPixel_px), tiles_.alpha.data(),
               tiles_.tint.data(), tiles_.glare.data());
}

void CoarseScan::Judge(const ExpectedHalf& expected) {
  values_.clear();
  for (std::size_t i = 0; i < live_.tiles(); i += kTileStep)
    if (IsKnown(expected, i)) values_.push_back(tiles_.misfit[i]);
  const float harmless =
      kHarmlessMisfit * std::max(values_.empty() ? 0 : Median(values_), kLeastMisfit);
  const int columns = live_.tile_columns();
  suspicious_.Reset(columns, live_.tile_rows());
  for (int row = 0; row < live_.tile_rows(); ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::size_t i = static_cast<std::size_t>(row) * columns + column;
      if (IsKnown(expected, i) &&
          (tiles_.tint[i] > kHarmlessTint || tiles_.misfit[i] > harmless ||
           tiles_.alpha[i] < darkest_shadow_ + kDarkMargin || tiles_.glare[i] > kHarmlessGlare))
        suspicious_.Set(column, row);
    }
  }
  cleaner_.DropBlobs(kFewestTiles, suspicious_);
}

}  // namespace mocap
