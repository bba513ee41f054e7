#include "core/reconstruction/silhouette/distortion_scan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr int kPixels = WeighedPixels::kPixels;
// Groups are fetched so many rows before they are needed.
constexpr int kRowsAhead = 2;

// Splits pixels into planes.
MOCAP_VECTORIZED
void Separate(const Bgr* pixels, int count, const std::array<float, 3>& gain, float* b, float* g,
              float* r) {
  const float gain0 = gain[0], gain1 = gain[1], gain2 = gain[2];
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    b[x] = gain0 * pixels[x].b;
    g[x] = gain1 * pixels[x].g;
    r[x] = gain2 * pixels[x].r;
  }
}

struct Distortions {
  float* alpha_shift;
  std::array<float*, 3> cd;
  float *cd_sq, *alpha_weight, *inverse_sigma;
};

// Measures pixels, one group after the other, and fetches those so many rows below.
MOCAP_VECTORIZED
void MeasureGroups(const WeighedPixels* groups, int stride,
                   const std::array<const float*, 3>& color, int count, int ahead,
                   const Distortions& d) {
  const auto [c0, c1, c2] = color;
  const auto [d0, d1, d2] = d.cd;
  float *const alpha_shift = d.alpha_shift, *const cd_sq = d.cd_sq;
  float *const alpha_weight = d.alpha_weight, *const inverse_sigma = d.inverse_sigma;
  for (int g = 0; g < count; ++g) {
    const WeighedPixels& group = groups[static_cast<std::ptrdiff_t>(g) * stride];
    FetchBytes(&group + ahead, sizeof group);
#pragma GCC ivdep
    for (int k = 0; k < kPixels; ++k) {
      const int x = g * kPixels + k;
      const float w0 = group.inverse_sigma[0][k] * WeighedPixels::kInverseSigmaUnit;
      const float w1 = group.inverse_sigma[1][k] * WeighedPixels::kInverseSigmaUnit;
      const float w2 = group.inverse_sigma[2][k] * WeighedPixels::kInverseSigmaUnit;
      const float m0 = group.mean[0][k] * (WeighedPixels::kMeanUnit * w0);
      const float m1 = group.mean[1][k] * (WeighedPixels::kMeanUnit * w1);
      const float m2 = group.mean[2][k] * (WeighedPixels::kMeanUnit * w2);
      const float z0 = c0[x] * w0, z1 = c1[x] * w1, z2 = c2[x] * w2;
      const float alpha = (z0 * m0 + z1 * m1 + z2 * m2) / (m0 * m0 + m1 * m1 + m2 * m2);
      const float f0 = z0 - alpha * m0;
      const float f1 = z1 - alpha * m1;
      const float f2 = z2 - alpha * m2;
      alpha_shift[x] = alpha - 1;
      d0[x] = f0;
      d1[x] = f1;
      d2[x] = f2;
      cd_sq[x] = f0 * f0 + f1 * f1 + f2 * f2;
      alpha_weight[x] = group.alpha_weight[k] * WeighedPixels::kAlphaWeightUnit;
      inverse_sigma[x] = w1;
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

// Sums along a line, `sums` leading to the line's place in the first of the blocks.
MOCAP_VECTORIZED
void SumBlocks(const float* alpha_shift, const std::array<const float*, 3>& cd, int blocks,
               BlockSums* sums) {
  for (int block = 0; block < blocks; ++block) {
    auto& [smaller, larger] = sums[block * kSumLines];
    const int x = block * kFloats;
    const auto itself = [](Floats&, float) {};
    const Neighbours alphas(alpha_shift + x);
    SumBoth(alphas, itself, smaller.alpha, larger.alpha);
    SumBoth(
        alphas, [](Floats& a, float) { a *= a; }, smaller.alpha_sq, larger.alpha_sq);
    SumBoth(
        alphas, [](Floats& a, float to_right) { a *= to_right; }, smaller.moment, larger.moment);
    for (int c = 0; c < 3; ++c) SumBoth(Neighbours(cd[c] + x), itself, smaller.cd[c], larger.cd[c]);
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
  for (Line& line : lines_) {
    for (auto* values : {&line.cd_sq, &line.alpha_weight, &line.inverse_sigma, &line.cd[0],
                         &line.cd[1], &line.cd[2]})
      values->assign(static_cast<std::size_t>(width), 0);
  }
  for (auto& color : color_) color.resize(static_cast<std::size_t>(width));
  sums_.resize(static_cast<std::size_t>(width / kFloats * kLines));
}

const DistortionScan::RowPair& DistortionScan::Next() {
  const int y = std::exchange(next_, next_ + 2);
  const int last = expected_->height - 1;
  MOCAP_CHECK(y <= last);
  for (; measured_ <= std::min(y + 1 + kLargestRadius_px, last); ++measured_) Measure(measured_);
  for (int row = 0; row < 2; ++row) {
    const int v = std::min(y + row, last);
    const Line& line = LineAt(v);
    pair_.rows[row] = {alpha_shift_.row(v) + kPad, line.cd_sq.data() + kPad,
                       line.alpha_weight.data() + kPad, line.inverse_sigma.data() + kPad};
  }
  for (int i = 0; i < kLines; ++i)
    pair_.sums[i] = &sums_[std::clamp(y + i - kLargestRadius_px, 0, last) % kLines];
  return pair_;
}

void DistortionScan::Measure(int y) {
  int done = 0;
  for (const PixelRun& run : closeup_->Measured(y)) {
    FetchPixels(image_, y + 1, run.begin, run.end);
    const int first = std::max(run.begin / kPixels, done);
    done = (run.end + kPixels - 1) / kPixels;
    const int whole = std::min(done, expected_->width / kPixels);
    MeasureFrom(y, first, image_.row(y) + first * kPixels, whole - first);
    if (whole == done) continue;
    // The picture ends within the last group.
    std::array<Bgr, kPixels> rest{};
    std::copy(image_.row(y) + whole * kPixels, image_.row(y) + expected_->width, rest.begin());
    MeasureFrom(y, whole, rest.data(), 1);
  }
  RepeatEnds(y);
  // What is summed beyond the ends is judged nowhere.
  for (const PixelRun& run : closeup_->Measured(y)) SumAlong(y, run);
}

void DistortionScan::MeasureFrom(int y, int group, const Bgr* pixels, int count) {
  const auto [b, g, r] = std::array{color_[0].data(), color_[1].data(), color_[2].data()};
  Separate(pixels, count * kPixels, gain_, b, g, r);
  const int first = group * kPixels + kPad;
  const int ahead = y + kRowsAhead < expected_->height ? kRowsAhead : 0;
  Line& line = LineAt(y);
  MeasureGroups(expected_->Group(group, y), expected_->height, {b, g, r}, count, ahead,
                {alpha_shift_.row(y) + first,
                 {&line.cd[0][first], &line.cd[1][first], &line.cd[2][first]},
                 &line.cd_sq[first],
                 &line.alpha_weight[first],
                 &line.inverse_sigma[first]});
}

void DistortionScan::RepeatEnds(int y) {
  const std::span<const PixelRun> runs = closeup_->Measured(y);
  if (runs.empty() || (runs.front().begin > 0 && runs.back().end < expected_->width)) return;
  Line& line = LineAt(y);
  for (float* const values :
       {alpha_shift_.row(y), line.cd[0].data(), line.cd[1].data(), line.cd[2].data()}) {
    float* const end = values + kPad + expected_->width;
    std::fill_n(values, kPad, values[kPad]);
    std::fill_n(end, kPad, end[-1]);
  }
}

void DistortionScan::SumAlong(int y, const PixelRun& run) {
  // Blocks that are judged anywhere lie well within the run.
  const int first = (run.begin + kFloats - 1) / kFloats;
  const int blocks = (run.end + kFloats - 1) / kFloats - first;
  const int begin = first * kFloats + kPad;
  const Line& line = LineAt(y);
  SumBlocks(alpha_shift_.row(y) + begin,
            {&line.cd[0][begin], &line.cd[1][begin], &line.cd[2][begin]}, blocks,
            &sums_[first * kLines + y % kLines]);
}

}  // namespace mocap
