#include "core/reconstruction/silhouette/coarse_scan.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/errors.h"
#include "core/kernels/statistics.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/bit_filters.h"
#include "core/reconstruction/silhouette/pixel_run.h"

namespace mocap {
namespace {

static_assert(Shading::kTile_px == HalfPicture::kTile_px);
constexpr int kTile = HalfPicture::kTile;
constexpr float kArea = kTile * kTile;
// Width of a pixel of the half picture, in pixels of the picture.
constexpr float kPixel_px = 2;
// This many tiles are enough for a median.
constexpr int kSamples = 200;
// Near black, colour ratios mean nothing [grey levels].
constexpr float kDarkest = 8;
constexpr float kLargestGain = 4;
// Values that differ from the median by more than this share are not background.
constexpr float kFlatness = 0.06f;
// Fewer contour pixels do not tell how far contours moved.
constexpr std::size_t kFewestSteep = 50;
constexpr float kLargestShift_px = 1;
// People, shadows and light reflected by them may cover more than half of the picture. So standard
// deviations are read at these quantiles. For a normal distribution, the quantiles lie at this
// length in three dimensions, and at this absolute value in one.
constexpr double kUndisturbedTiles = 0.4;
constexpr float kUndisturbedLength = 1.367f;
constexpr double kUndisturbedContours = 0.25;
constexpr float kUndisturbedSize = 0.3186f;
// Up to this factor, a deviation counts as usual. The other two limits are for what is left [grey
// levels, pixels].
constexpr float kNotable = 1.5f;
constexpr float kNegligibleDrift = 0.3f;
constexpr float kNegligibleShift_px = 0.1f;
// Drift is not normally distributed: some walls change, others do not.
constexpr float kDriftMargin = 4;
constexpr float kLargestDrift = 8;
// Limits in variances. A tile is suspicious if it is brighter or tinted by more than these; if its
// pixels differ by this factor more than those of most tiles; or if it is nearly too dark for a
// shadow. The last two factors scale distance and shift, which are part of the variance.
constexpr float kHarmlessGlare = 1.5f;
constexpr float kHarmlessTint = 1.5f;
constexpr float kHarmlessChiSquare = 6;
constexpr float kLeastChiSquare = 0.05f;
constexpr float kDarkMargin = 0.02f;
constexpr float kDistanceMargin = 2;
constexpr float kContourMargin = 2;
// Fewer adjacent tiles are noise.
constexpr int kFewestTiles = 4;
// From one picture to the next, the whole rows move on by this step, so that they soon meet what
// grows from one side.
constexpr int kBandStep = 3;
// Tiles to scan around suspicious ones.
constexpr int kRegionMargin = 3;
// Tiles to scan around shadows. Tiles of shadows are darker by the share kShade.
constexpr int kShadowMargin = 1;
constexpr float kShade = 0.02f;

float Square(float x) { return x * x; }

float Quantile(const std::vector<float>& values, double share) {
  MOCAP_CHECK(!values.empty());
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

CoarseScan::CoarseScan(float darkest_shadow) : darkest_shadow_(darkest_shadow) {}

void CoarseScan::Compare(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  Resize(expected, image);
  LookAtAll();
  CompareTiles(expected, image);
  Conclude();
}

void CoarseScan::Watch(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  Resize(expected, image);
  if (!knows_region_) return Compare(expected, image);
  LookAtRegion();
  CompareTiles(expected, image);
  if (conditions_.shift_px > 0 || ShowsBesideRegion()) return Compare(expected, image);
  Conclude();
}

void CoarseScan::LookAtAll() {
  looks_.clear();
  for (int row = 0; row < live_.tile_rows(); ++row) looks_.push_back(live_.RowOfTiles(row));
  SampleWholeRows();
}

void CoarseScan::LookAtRegion() {
  looks_.clear();
  first_band_ = (first_band_ + kBandStep) % kBandRows;
  for (int row = first_band_; row < live_.tile_rows(); row += kBandRows)
    looks_.push_back(live_.RowOfTiles(row));
  SampleWholeRows();
  for (int row = 0; row < live_.tile_rows(); ++row) {
    if (row % kBandRows == first_band_) continue;
    ForEachRun(region_.row(row), 0, region_.width(), 0, [&](const PixelRun& run) {
      looks_.push_back({row, run.begin, run.end});
    });
  }
}

void CoarseScan::SampleWholeRows() {
  whole_rows_ = looks_.size();
  const int columns = live_.tile_columns();
  const int tiles = static_cast<int>(whole_rows_) * columns;
  const int step = tiles / kSamples | 1;  // Odd: few pictures have a multiple of it as width.
  samples_.clear();
  for (int i = 0; i < tiles; i += step)
    samples_.push_back(live_.FirstTileOf(looks_[i / columns]) + i % columns);
}

void CoarseScan::CompareTiles(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  for (std::size_t i = 0; i < whole_rows_; ++i) Take(image, i);
  for (int c = 0; c < 3; ++c) conditions_.gain[c] = MeasureGain(expected, c);
  distance_ = MeasureDistance(expected);
  conditions_.drift = std::min(
      kDriftMargin * Beyond(distance_, expected.usual_distance, kNegligibleDrift), kLargestDrift);
  shift_px_ = MeasureShift(expected);
  conditions_.shift_px = Beyond(shift_px_, expected.usual_shift_px, kNegligibleShift_px);
  allowance_ = {conditions_.gain, Square(std::max(conditions_.drift, kDistanceMargin * distance_)),
                Square(kContourMargin * shift_px_ / kPixel_px)};
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    FetchTiles(expected, looks_[i]);
    if (i >= whole_rows_) Take(image, i);
    MeasureTints(expected, looks_[i]);
    MeasureChiSquare(expected, looks_[i]);
  }
  Judge(expected);
}

void CoarseScan::Take(ImageView<const Bgr> image, std::size_t look) {
  if (look + 1 < looks_.size()) FetchPicture(image, looks_[look + 1]);
  Halve(image, looks_[look], live_);
}

// A single tile is noise. What reaches the region's edge extends beyond it.
bool CoarseScan::ShowsBesideRegion() const {
  const int words = suspicious_.words_per_row();
  for (int row = 0; row < suspicious_.height(); ++row) {
    const std::uint64_t* const shown = suspicious_.row(row);
    const std::uint64_t* const inner = inner_region_.row(row);
    for (int i = 0; i < words; ++i) {
      const auto in_pairs = [&](const std::uint64_t* tiles) {
        return tiles[i] & (tiles[i] >> 1 | (i + 1 < words ? tiles[i + 1] << 63 : 0));
      };
      if ((in_pairs(shown) & ~in_pairs(inner)) != 0) return true;
    }
  }
  return false;
}

void CoarseScan::Conclude() {
  cleaner_.DropBlobs(kFewestTiles, suspicious_);
  Dilate(suspicious_, kRegionMargin, region_);
  Erode(region_, 1, inner_region_);
  cleaner_.DropBlobs(kFewestTiles, shaded_);
  Dilate(shaded_, kShadowMargin, shadows_);
  Unite(shadows_, region_);
  knows_region_ = true;
}

void CoarseScan::Resize(const ExpectedHalf& expected, ImageView<const Bgr> image) {
  if (image.width() != full_width_ || image.height() != full_height_) {
    full_width_ = image.width();
    full_height_ = image.height();
    knows_region_ = false;
    live_ = HalfPicture(full_width_, full_height_);
    for (auto* values : {&tiles_.alpha, &tiles_.tint, &tiles_.glare, &tiles_.chi_square})
      values->resize(live_.tiles());
    shades_.assign(live_.tiles(), Shading::kUnknown);
  }
  MOCAP_CHECK(expected.mean.width == live_.width && expected.mean.height == live_.height);
}

float CoarseScan::MeasureGain(const ExpectedHalf& expected_half, int channel) {
  const std::vector<float>& live = live_.tile_mean[channel];
  const std::vector<float>& expected = expected_half.mean.tile_mean[channel];
  values_.clear();
  for (const std::size_t i : samples_)
    if (IsKnown(expected_half, i) && expected[i] >= kDarkest)
      values_.push_back(live[i] / expected[i]);
  if (values_.empty()) return 1;
  // People and shadows lie mostly on one side of the median, so it is computed again without them.
  const float rough = Median(values_);
  std::erase_if(values_, [rough](float v) { return std::abs(v - rough) > kFlatness * rough; });
  const float fine = values_.empty() ? rough : Median(values_);
  return std::clamp(1 / std::max(fine, 1e-3f), 1 / kLargestGain, kLargestGain);
}

float CoarseScan::MeasureDistance(const ExpectedHalf& expected) {
  values_.clear();
  for (const std::size_t i : samples_) {
    if (!IsKnown(expected, i)) continue;
    float length_sq = 0;
    for (int c = 0; c < 3; ++c) {
      const float d = conditions_.gain[c] * live_.tile_mean[c][i] - expected.mean.tile_mean[c][i];
      length_sq += d * d;
    }
    values_.push_back(length_sq);
  }
  return values_.empty() ? 0 : std::sqrt(Quantile(values_, kUndisturbedTiles)) / kUndisturbedLength;
}

float CoarseScan::MeasureShift(const ExpectedHalf& expected) {
  values_.clear();
  const float gain = conditions_.gain[1];
  const int pixels_per_row = kTile * live_.width;
  for (std::size_t look = 0; look < whole_rows_; ++look) {
    const int row = looks_[look].row;
    const auto end = std::ranges::lower_bound(expected.steep, (row + 1) * pixels_per_row);
    for (auto i = std::ranges::lower_bound(expected.steep, row * pixels_per_row); i != end; ++i) {
      const float difference = gain * live_.color[1][*i] - expected.mean.color[1][*i];
      values_.push_back(std::abs(difference) / static_cast<float>(expected.slope[*i]));
    }
  }
  // A low picture may contain no whole row.
  const bool is_telling =
      values_.size() * live_.tile_rows() >= kFewestSteep * whole_rows_ && !values_.empty();
  if (!is_telling) return 0;
  return std::min(kPixel_px / kUndisturbedSize * Quantile(values_, kUndisturbedContours),
                  kLargestShift_px);
}

void CoarseScan::FetchPicture(ImageView<const Bgr> image, const TileRun& run) {
  constexpr int kTile_px = HalfPicture::kTile_px;
  for (int row = run.row * kTile_px; row < (run.row + 1) * kTile_px; ++row)
    FetchPixels(image, row, run.begin * kTile_px, run.end * kTile_px);
}

void CoarseScan::FetchTiles(const ExpectedHalf& expected, const TileRun& run) {
  const std::size_t count = static_cast<std::size_t>(run.end - run.begin) * kTile;
  for (int y = run.row * kTile; y < (run.row + 1) * kTile; ++y) {
    const std::size_t begin = static_cast<std::size_t>(y) * live_.width + run.begin * kTile;
    for (const auto& plane : expected.mean.color) FetchBytes(&plane[begin], count);
    FetchBytes(&expected.variance[begin], count * sizeof(float));
    FetchBytes(&expected.slope[begin], count);
  }
}

kernels::TilePixels CoarseScan::PixelsOf(const ExpectedHalf& expected, const TileRun& run) const {
  const std::size_t begin = live_.FirstPixelOf(run);
  kernels::TilePixels tiles{{}, {}, &expected.variance[begin], &expected.slope[begin], live_.width};
  for (int c = 0; c < 3; ++c) {
    tiles.live[c] = &live_.color[c][begin];
    tiles.expected[c] = &expected.mean.color[c][begin];
  }
  return tiles;
}

void CoarseScan::MeasureChiSquare(const ExpectedHalf& expected, const TileRun& run) {
  const std::size_t first = live_.FirstTileOf(run);
  kernels::MeasureChiSquares(PixelsOf(expected, run), run.end - run.begin, allowance_,
                             &tiles_.alpha[first], &tiles_.chi_square[first]);
}

void CoarseScan::MeasureTints(const ExpectedHalf& expected, const TileRun& run) {
  const std::size_t first = live_.FirstTileOf(run);
  kernels::TileMeans tiles{{}, {}, &expected.tile_variance[first], &expected.tile_slope_sq[first]};
  for (int c = 0; c < 3; ++c) {
    tiles.live[c] = &live_.tile_mean[c][first];
    tiles.expected[c] = &expected.mean.tile_mean[c][first];
  }
  kernels::MeasureTiles(tiles, run.end - run.begin, allowance_, &tiles_.alpha[first],
                        &tiles_.tint[first], &tiles_.glare[first]);
}

void CoarseScan::Judge(const ExpectedHalf& expected) {
  values_.clear();
  for (const std::size_t i : samples_)
    if (IsKnown(expected, i)) values_.push_back(tiles_.chi_square[i]);
  const float harmless =
      kHarmlessChiSquare * std::max(values_.empty() ? 0 : Median(values_), kLeastChiSquare);
  suspicious_.Reset(live_.tile_columns(), live_.tile_rows());
  shaded_.Reset(live_.tile_columns(), live_.tile_rows());
  for (const TileRun& look : looks_) {
    for (int column = look.begin; column < look.end; ++column) {
      const std::size_t i = live_.FirstTileOf(look) + (column - look.begin);
      shades_[i] = Shading::kUnknown;
      if (!IsKnown(expected, i)) continue;
      shades_[i] = Shading::ShadeOf(tiles_.alpha[i] - 1);
      if (tiles_.alpha[i] - 1 < -kShade) shaded_.Set(column, look.row);
      if (tiles_.tint[i] > kHarmlessTint || tiles_.alpha[i] < darkest_shadow_ + kDarkMargin ||
          tiles_.glare[i] > kHarmlessGlare ||
          (tiles_.chi_square[i] > harmless &&
           kernels::ChiSquareBesideSlope(PixelsOf(expected, {look.row, column, column + 1}),
                                         allowance_) > harmless))
        suspicious_.Set(column, look.row);
    }
  }
}

}  // namespace mocap
