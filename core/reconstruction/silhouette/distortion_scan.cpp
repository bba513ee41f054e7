#include "core/reconstruction/silhouette/distortion_scan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr int kPixels = WeighedPixels::kPixels;

// Where what is measured goes, in rows so many numbers apart.
struct Distortions {
  float* alpha_shift;
  std::array<float*, 3> cd;
  float *cd_sq, *alpha_weight, *inverse_sigma;
  int row_step;
};

// Measures a band of pixels group by group, and fetches the groups of the next band.
// @param groups  what they are held against: of the first group, the next so many on.
MOCAP_VECTORIZED
void MeasureGroups(const WeighedPixels* groups, int group_step, ImageView<const Bgr> band,
                   const std::array<float, 3>& gain, int ahead, const Distortions& to) {
  const auto [gain0, gain1, gain2] = gain;
  const auto [to0, to1, to2] = to.cd;
  for (int begin = 0; begin < band.width(); begin += kPixels, groups += group_step) {
    for (int row = 0; row < band.height(); ++row) {
      const WeighedPixels& group = groups[row];
      FetchBytes(&group + ahead, sizeof group);
      const Bgr* const pixels = band.row(row) + begin;
      const int first = row * to.row_step + begin;
      float *const alpha_shift = to.alpha_shift + first, *const cd_sq = to.cd_sq + first;
      FetchBytes(alpha_shift + ahead * to.row_step, sizeof(float) * kPixels);
      float* const alpha_weight = to.alpha_weight + first;
      float* const inverse_sigma = to.inverse_sigma + first;
      float *const d0 = to0 + first, *const d1 = to1 + first, *const d2 = to2 + first;
#pragma GCC ivdep
      for (int k = 0; k < kPixels; ++k) {
        const float w0 = group.inverse_sigma[0][k] * WeighedPixels::kInverseSigmaUnit;
        const float w1 = group.inverse_sigma[1][k] * WeighedPixels::kInverseSigmaUnit;
        const float w2 = group.inverse_sigma[2][k] * WeighedPixels::kInverseSigmaUnit;
        const float m0 = group.mean[0][k] * (WeighedPixels::kMeanUnit * w0);
        const float m1 = group.mean[1][k] * (WeighedPixels::kMeanUnit * w1);
        const float m2 = group.mean[2][k] * (WeighedPixels::kMeanUnit * w2);
        const float z0 = gain0 * pixels[k].b * w0;
        const float z1 = gain1 * pixels[k].g * w1;
        const float z2 = gain2 * pixels[k].r * w2;
        const float alpha = (z0 * m0 + z1 * m1 + z2 * m2) / (m0 * m0 + m1 * m1 + m2 * m2);
        const float f0 = z0 - alpha * m0;
        const float f1 = z1 - alpha * m1;
        const float f2 = z2 - alpha * m2;
        alpha_shift[k] = alpha - 1;
        d0[k] = f0;
        d1[k] = f1;
        d2[k] = f2;
        cd_sq[k] = f0 * f0 + f1 * f1 + f2 * f2;
        alpha_weight[k] = group.alpha_weight[k] * WeighedPixels::kAlphaWeightUnit;
        inverse_sigma[k] = w1;
      }
    }
  }
}

constexpr int kSmaller = kWindowRadii_px[0], kLarger = kWindowRadii_px[1];
static_assert(kWindows == 2 && kLarger == kSmaller + 1);

// Values and those to their left and right.
struct Neighbours {
  MOCAP_INLINE explicit Neighbours(const float* values) {
#pragma GCC unroll 7
    for (int i = -kLarger; i <= kLarger; ++i) LoadLanes(values + i, at[i + kLarger]);
  }
  // The sum of term(−radius), … term(radius), where `term` is given a value and replaces it.
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

// Sums within the smaller width, and from there within the larger, which is two pixels more.
template <typename Term>
MOCAP_INLINE void SumBoth(const Neighbours& values, Term term, LineSums::Column& smaller,
                          LineSums::Column& larger) {
  Floats sum, first = values.at[0], last = values.at[2 * kLarger];
  values.Sum<kSmaller>(term, sum);
  StoreLanes(sum, smaller.data());
  term(first, static_cast<float>(-kLarger)), term(last, static_cast<float>(kLarger));
  StoreLanes(sum + first + last, larger.data());
}

// Sums along lines, `sums` leading to the place of the first in the first of the blocks.
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
                           const std::array<float, 3>& gain, const Closeup& closeup) {
  MOCAP_CHECK(image.width() == expected.width && image.height() == expected.height);
  MOCAP_CHECK(closeup.width() == expected.width && closeup.height() == expected.height);
  expected_ = &expected;
  closeup_ = &closeup;
  image_ = image;
  gain_ = gain;
  next_ = measured_ = closeup.frame().top;
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
  for (const PixelRun& run : closeup_->Measured(y)) {
    for (int row = 0; row < rows; ++row)
      FetchPixels(image_, y + kBand_px + row, run.begin, run.end);
    const int first = std::max(run.begin / kPixels, done);
    done = (run.end + kPixels - 1) / kPixels;
    Measure(image_.Section(first * kPixels, y, (std::min(done, whole) - first) * kPixels, rows), y,
            first);
    if (done > whole) MeasureLast(y, rows);
  }
  for (int row = 0; row < rows; ++row) RepeatEnds(y + row);
  // What is summed beyond the ends is judged nowhere.
  for (const PixelRun& run : closeup_->Measured(y)) SumAlong(y, rows, run);
}

// The picture ends within the last group.
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
  const std::span<const PixelRun> runs = closeup_->Measured(y);
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
  // Blocks that are judged anywhere lie well within the run.
  const int first = (run.begin + kFloats - 1) / kFloats;
  const int blocks = (run.end + kFloats - 1) / kFloats - first;
  const int x = first * kFloats + kPad, line = y % kSumLines;
  SumBlocks(alpha_shift_.row(y) + x,
            {lines_.cd[0].row(line) + x, lines_.cd[1].row(line) + x, lines_.cd[2].row(line) + x},
            alpha_shift_.width(), blocks, rows, &sums_[first * kSumLines + line]);
}

}  // namespace mocap
