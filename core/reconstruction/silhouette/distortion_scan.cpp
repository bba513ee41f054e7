#include "core/reconstruction/silhouette/distortion_scan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "core/reconstruction/silhouette/pixel_lanes.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr int kPixels = WeighedPixels::kPixels;

// Destination of the measurements, in rows `row_step` numbers apart.
struct Distortions {
  float* alpha_shift;
  std::array<float*, 3> cd;
  float *cd_sq, *alpha_weight, *inverse_sigma;
  int row_step;

  // The same, from a position on.
  MOCAP_INLINE Distortions From(int i) const {
    return {alpha_shift + i,   {cd[0] + i, cd[1] + i, cd[2] + i},
            cd_sq + i,         alpha_weight + i,
            inverse_sigma + i, row_step};
  }
};

// Measures eight pixels, from pixel `k` of a group on.
MOCAP_INLINE void MeasurePixels(const WeighedPixels& group, int k, const Bgr* pixels,
                                const std::array<float, 3>& gain, const Distortions& to) {
  Ints packed;
  LoadPixels(pixels, packed);
  std::array<Floats, 3> m, z, w, cd;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    w[c] = LoadShorts(&group.inverse_sigma[c][k], WeighedPixels::kInverseSigmaUnit);
    m[c] = LoadShorts(&group.mean[c][k], 1) * (WeighedPixels::kMeanUnit * w[c]);
    z[c] = gain[c] * ChannelOf(packed, c) * w[c];
  }
  const Floats alpha =
      (z[0] * m[0] + z[1] * m[1] + z[2] * m[2]) / (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    cd[c] = z[c] - alpha * m[c];
    StoreLanes(cd[c], to.cd[c]);
  }
  StoreLanes(alpha - 1, to.alpha_shift);
  StoreLanes(cd[0] * cd[0] + cd[1] * cd[1] + cd[2] * cd[2], to.cd_sq);
  StoreLanes(LoadShorts(&group.alpha_weight[k], WeighedPixels::kAlphaWeightUnit), to.alpha_weight);
  StoreLanes(w[1], to.inverse_sigma);
}

// Measures a band of pixels group by group, and prefetches the groups of the next band.
// @param groups  first expected group; the next ones follow in steps of `group_step`.
MOCAP_VECTORIZED
void MeasureGroups(const WeighedPixels* groups, int group_step, ImageView<const Bgr> band,
                   const std::array<float, 3>& gain, int ahead, const Distortions& to) {
  for (int begin = 0; begin < band.width(); begin += kPixels, groups += group_step) {
    for (int row = 0; row < band.height(); ++row) {
      const WeighedPixels& group = groups[row];
      FetchBytes(&group + ahead, sizeof group);
      const int first = row * to.row_step + begin;
      FetchBytes(to.alpha_shift + first + ahead * to.row_step, sizeof(float) * kPixels);
#pragma GCC unroll 2
      for (int k = 0; k < kPixels; k += kFloats)
        MeasurePixels(group, k, band.row(row) + begin + k, gain, to.From(first + k));
    }
  }
}

constexpr int kSmaller = kWindowRadii_px[0], kLarger = kWindowRadii_px[1];
static_assert(kWindows == 2 && kLarger == kSmaller + 1);

// Values and their neighbours to the left and right.
struct Neighbours {
  MOCAP_INLINE explicit Neighbours(const float* values) {
#pragma GCC unroll 7
    for (int i = -kLarger; i <= kLarger; ++i) LoadLanes(values + i, at[i + kLarger]);
  }
  // Sums term(−radius), … term(radius), where `term` gets a value and replaces it.
  template <int radius, typename Term>
  MOCAP_INLINE void Sum(Term term, Floats& sum) const {
    sum = Floats{};
#pragma GCC unroll 7
    for (int i = radius; i >= -radius; --i) {
      Floats value = at[i + kLarger];
      term(value, static_cast<float>(i));
      sum = value + sum;
    }
  }
  Floats at[2 * kLarger + 1];
};

// Sums over the smaller width, and from there over the larger one, which is two pixels wider.
template <typename Term>
MOCAP_INLINE void SumBoth(const Neighbours& values, Term term, LineSums::Column& smaller,
                          LineSums::Column& larger) {
  Floats sum, first = values.at[0], last = values.at[2 * kLarger];
  values.Sum<kSmaller>(term, sum);
  StoreLanes(sum, smaller.data());
  term(first, static_cast<float>(-kLarger)), term(last, static_cast<float>(kLarger));
  StoreLanes(sum + first + last, larger.data());
}

// Sums along lines. `sums` points to the first line in the first block.
MOCAP_VECTORIZED
void SumBlocks(const float* alpha_shift, const std::array<const float*, 3>& cd, int row_step,
               int blocks, int rows, BlockSums* sums) {
  for (int block = 0; block < blocks; ++block) {
    for (int row = 0; row < rows; ++row) {
      auto& [smaller, larger] = sums[block * kSumLines + row];
      const int x = block * kFloats + row * row_step;
      const auto itself = [](Floats&, float) {};
      const Neighbours alphas(alpha_shift + x);
      SumBoth(alphas, itself, smaller.alpha, larger.alpha);
      SumBoth(
          alphas, [](Floats& a, float) { a *= a; }, smaller.alpha_sq, larger.alpha_sq);
      SumBoth(
          alphas, [](Floats& a, float to_right) { a *= to_right; }, smaller.moment, larger.moment);
      for (int c = 0; c < 3; ++c)
        SumBoth(Neighbours(cd[c] + x), itself, smaller.cd[c], larger.cd[c]);
    }
  }
}

}  // namespace

void DistortionScan::Begin(const ExpectedPicture& expected, ImageView<const Bgr> image,
                           const std::array<float, 3>& gain, const RegionOfInterest& roi) {
  MOCAP_CHECK(image.width() == expected.width && image.height() == expected.height);
  MOCAP_CHECK(roi.width() == expected.width && roi.height() == expected.height);
  expected_ = &expected;
  roi_ = &roi;
  image_ = image;
  gain_ = gain;
  next_ = measured_ = roi.frame().top;
  const int width = expected.width + kBeside;
  if (alpha_shift_.width() == width && alpha_shift_.height() == expected.height) return;
  alpha_shift_ = Image<float>(width, expected.height);
  for (auto* lines : {&lines_.cd_sq, &lines_.alpha_weight, &lines_.inverse_sigma, &lines_.cd[0],
                      &lines_.cd[1], &lines_.cd[2]})
    *lines = Image<float>(width, kSumLines);
  last_ = Image<Bgr>(kPixels, kBand_px);
  sums_.resize(static_cast<std::size_t>(width / kFloats * kSumLines));
}

const DistortionScan::RowPair& DistortionScan::Next() {
  const int y = std::exchange(next_, next_ + 2);
  const int last = expected_->height - 1;
  MOCAP_CHECK(y <= last);
  for (; measured_ <= std::min(y + 1 + kLargestRadius_px, last); measured_ += kBand_px)
    MeasureBand(measured_);
  for (int row = 0; row < 2; ++row) {
    const int v = std::min(y + row, last), line = v % kSumLines;
    pair_.rows[row] = {alpha_shift_.row(v) + kPad, lines_.cd_sq.row(line) + kPad,
                       lines_.alpha_weight.row(line) + kPad, lines_.inverse_sigma.row(line) + kPad};
  }
  for (int i = 0; i < kPairLines; ++i)
    pair_.sums[i] = &sums_[std::clamp(y + i - kLargestRadius_px, 0, last) % kSumLines];
  return pair_;
}

void DistortionScan::MeasureBand(int y) {
  const int rows = std::min(kBand_px, expected_->height - y);
  const int whole = expected_->width / kPixels;
  int done = 0;
  for (const PixelRun& run : roi_->Measured(y)) {
    for (int row = 0; row < rows; ++row)
      FetchPixels(image_, y + kBand_px + row, run.begin, run.end);
    const int first = std::max(run.begin / kPixels, done);
    done = (run.end + kPixels - 1) / kPixels;
    Measure(image_.Section(first * kPixels, y, (std::min(done, whole) - first) * kPixels, rows), y,
            first);
    if (done > whole) MeasureLast(y, rows);
  }
  for (int row = 0; row < rows; ++row) RepeatEnds(y + row);
  // Sums beyond the ends are never used.
  for (const PixelRun& run : roi_->Measured(y)) SumAlong(y, rows, run);
}

// Measures the group in which the picture ends.
void DistortionScan::MeasureLast(int y, int rows) {
  const int group = expected_->width / kPixels, left = group * kPixels;
  for (int row = 0; row < rows; ++row)
    std::copy(image_.row(y + row) + left, image_.row(y + row) + expected_->width, last_.row(row));
  Measure(last_.view().Section(0, 0, kPixels, rows), y, group);
}

void DistortionScan::Measure(ImageView<const Bgr> pixels, int y, int group) {
  const int x = group * kPixels + kPad, line = y % kSumLines;
  MeasureGroups(
      expected_->Group(group, y), expected_->height, pixels, gain_,
      y + 2 * kBand_px <= expected_->height ? kBand_px : 0,
      {alpha_shift_.row(y) + x,
       {lines_.cd[0].row(line) + x, lines_.cd[1].row(line) + x, lines_.cd[2].row(line) + x},
       lines_.cd_sq.row(line) + x,
       lines_.alpha_weight.row(line) + x,
       lines_.inverse_sigma.row(line) + x,
       alpha_shift_.width()});
}

void DistortionScan::RepeatEnds(int y) {
  const std::span<const PixelRun> runs = roi_->Measured(y);
  if (runs.empty() || (runs.front().begin > 0 && runs.back().end < expected_->width)) return;
  const int line = y % kSumLines;
  for (float* const values : {alpha_shift_.row(y), lines_.cd[0].row(line), lines_.cd[1].row(line),
                              lines_.cd[2].row(line)}) {
    float* const end = values + kPad + expected_->width;
    std::fill_n(values, kPad, values[kPad]);
    std::fill_n(end, kPad, end[-1]);
  }
}

void DistortionScan::SumAlong(int y, int rows, const PixelRun& run) {
  // Blocks with judged pixels lie well within the run.
  const int first = (run.begin + kFloats - 1) / kFloats;
  const int blocks = (run.end + kFloats - 1) / kFloats - first;
  const int x = first * kFloats + kPad, line = y % kSumLines;
  SumBlocks(alpha_shift_.row(y) + x,
            {lines_.cd[0].row(line) + x, lines_.cd[1].row(line) + x, lines_.cd[2].row(line) + x},
            alpha_shift_.width(), blocks, rows, &sums_[first * kSumLines + line]);
}

}  // namespace mocap
