#include "core/reconstruction/silhouette/distortion_scan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"
#include "core/vectorized.h"

namespace mocap {
namespace {

// The sum of f(0) + … + f(count − 1), written out, so that loops around it are vectorized.
template <int count, typename Function>
inline float Sum(Function f) {
  return [&]<int... i>(std::integer_sequence<int, i...>) { return (f(i) + ...); }
  (std::make_integer_sequence<int, count>{});
}

constexpr int SideOf(std::size_t window) { return 2 * DistortionScan::kRadii_px[window] + 1; }

constexpr int kPixels = WeighedPixels::kPixels;

struct Distortions {
  float* alpha_shift;
  std::array<float*, 3> cd;
  float *cd_sq, *alpha_weight, *inverse_sigma;
};

// Measures pixels, one group after the other.
MOCAP_VECTORIZED
void MeasureGroups(const WeighedPixels* groups, const Bgr* pixels, int count,
                   const std::array<float, 3>& gain, const Distortions& d) {
  const float gain0 = gain[0], gain1 = gain[1], gain2 = gain[2];
  for (int g = 0; g < count; ++g) {
    const WeighedPixels& group = groups[g];
    const Bgr* const from = pixels + g * kPixels;
    const int first = g * kPixels;
    alignas(32) std::array<std::array<float, kPixels>, 3> color;
#pragma GCC ivdep
    for (int k = 0; k < kPixels; ++k) {
      color[0][k] = from[k].b * gain0;
      color[1][k] = from[k].g * gain1;
      color[2][k] = from[k].r * gain2;
    }
    float *const alpha_shift = d.alpha_shift + first, *const cd_sq = d.cd_sq + first;
    float *const d0 = d.cd[0] + first, *const d1 = d.cd[1] + first, *const d2 = d.cd[2] + first;
    float* const alpha_weight = d.alpha_weight + first;
    float* const inverse_sigma = d.inverse_sigma + first;
#pragma GCC ivdep
    for (int k = 0; k < kPixels; ++k) {
      const float w0 = group.inverse_sigma[0][k] * WeighedPixels::kInverseSigmaUnit;
      const float w1 = group.inverse_sigma[1][k] * WeighedPixels::kInverseSigmaUnit;
      const float w2 = group.inverse_sigma[2][k] * WeighedPixels::kInverseSigmaUnit;
      const float m0 = group.mean[0][k] * (WeighedPixels::kMeanUnit * w0);
      const float m1 = group.mean[1][k] * (WeighedPixels::kMeanUnit * w1);
      const float m2 = group.mean[2][k] * (WeighedPixels::kMeanUnit * w2);
      const float z0 = color[0][k] * w0, z1 = color[1][k] * w1, z2 = color[2][k] * w2;
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

// Of a row, within the width of a window.
struct RowSums {
  float *alpha, *alpha_sq, *moment;
  std::array<float*, 3> cd;
};

// Sums within the smaller width, and from there within the larger, which is two pixels more.
template <int side>
MOCAP_VECTORIZED void SumAlphas(const float* alpha, int count, const RowSums& smaller,
                                const RowSums& larger) {
  float *const s0 = smaller.alpha, *const q0 = smaller.alpha_sq, *const m0 = smaller.moment;
  float *const s1 = larger.alpha, *const q1 = larger.alpha_sq, *const m1 = larger.moment;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float first = alpha[x], last = alpha[x + side + 1];
    const float sum = Sum<side>([&](int i) { return alpha[x + i + 1]; });
    const float sum_sq = Sum<side>([&](int i) { return alpha[x + i + 1] * alpha[x + i + 1]; });
    const float moment =
        Sum<side>([&](int i) { return static_cast<float>(i - side / 2) * alpha[x + i + 1]; });
    s0[x] = sum;
    q0[x] = sum_sq;
    m0[x] = moment;
    s1[x] = sum + first + last;
    q1[x] = sum_sq + first * first + last * last;
    m1[x] = moment + static_cast<float>(side / 2 + 1) * (last - first);
  }
}

template <int side>
MOCAP_VECTORIZED void SumColors(const std::array<const float*, 3>& cd, int count,
                                const RowSums& smaller, const RowSums& larger) {
  for (int c = 0; c < 3; ++c) {
    const float* const from = cd[c];
    float *const s0 = smaller.cd[c], *const s1 = larger.cd[c];
#pragma GCC ivdep
    for (int x = 0; x < count; ++x) {
      const float sum = Sum<side>([&](int i) { return from[x + i + 1]; });
      s0[x] = sum;
      s1[x] = sum + from[x] + from[x + side + 1];
    }
  }
}

template <int side>
using Column = std::array<const float*, side>;

template <int side>
MOCAP_VECTORIZED void JoinAlphas(const Column<side>& sum, const Column<side>& sum_sq,
                                 const Column<side>& moment, const float* alpha_weight, int count,
                                 float* alpha_shift, float* roughness_sq) {
  constexpr float kArea = side * side;
  // Sum of x² over the window's pixels, counted from its middle.
  constexpr float kSpread = kArea * (kArea - 1) / 12;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float a = Sum<side>([&](int i) { return sum[i][x]; });
    const float a_sq = Sum<side>([&](int i) { return sum_sq[i][x]; });
    const float along = Sum<side>([&](int i) { return moment[i][x]; });
    const float down =
        Sum<side>([&](int i) { return static_cast<float>(i - side / 2) * sum[i][x]; });
    const float variance = (a_sq - a * a / kArea - (along * along + down * down) / kSpread) / kArea;
    alpha_shift[x] = a / kArea;
    roughness_sq[x] = variance * alpha_weight[x] * alpha_weight[x];
  }
}

template <int side>
MOCAP_VECTORIZED void JoinColors(const std::array<Column<side>, 3>& sums, int count, float* cd_sq) {
  constexpr float kArea = side * side;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float d0 = Sum<side>([&](int i) { return sums[0][i][x]; });
    const float d1 = Sum<side>([&](int i) { return sums[1][i][x]; });
    const float d2 = Sum<side>([&](int i) { return sums[2][i][x]; });
    cd_sq[x] = (d0 * d0 + d1 * d1 + d2 * d2) / (kArea * kArea);
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
  next_ = 0;
  measured_ = 0;
  // Whole groups are measured.
  const auto width = static_cast<std::size_t>(expected.width) + kPixels;
  for (Line& line : lines_) {
    line.alpha_shift.resize(width + 2 * kPad);
    for (auto& cd : line.cd) cd.resize(width + 2 * kPad);
    for (auto* values : {&line.cd_sq, &line.alpha_weight, &line.inverse_sigma})
      values->resize(width);
    for (Sums& sums : line.sums) {
      for (auto* values : {&sums.alpha, &sums.alpha_sq, &sums.moment}) values->resize(width);
      for (auto& cd : sums.cd) cd.resize(width);
    }
  }
  for (Results& r : results_)
    for (auto* values : {&r.alpha_shift, &r.cd_sq, &r.roughness_sq}) values->resize(width);
}

const DistortionScan::Row& DistortionScan::Next() {
  const int y = next_++;
  MOCAP_CHECK(y < expected_->height);
  for (; measured_ <= std::min(y + kPad, expected_->height - 1); ++measured_)
    Measure(measured_, lines_[static_cast<std::size_t>(measured_ % kLines)]);
  for (const PixelRun& run : closeup_->Judged(y)) {
    SumDown<0>(y, run);
    SumDown<1>(y, run);
  }
  const Line& line = lines_[static_cast<std::size_t>(y % kLines)];
  row_.alpha_shift = line.alpha_shift.data() + kPad;
  row_.cd_sq = line.cd_sq.data();
  row_.alpha_weight = line.alpha_weight.data();
  row_.inverse_sigma = line.inverse_sigma.data();
  for (std::size_t w = 0; w < kWindows; ++w)
    row_.windows[w] = {results_[w].alpha_shift.data(), results_[w].cd_sq.data(),
                       results_[w].roughness_sq.data()};
  return row_;
}

void DistortionScan::Measure(int y, Line& line) const {
  int done = 0;
  for (const PixelRun& run : closeup_->Measured(y)) {
    const int first = std::max(run.begin / kPixels, done);
    done = (run.end + kPixels - 1) / kPixels;
    const int whole = std::min(done, expected_->width / kPixels);
    MeasureFrom(y, first, image_.row(y) + first * kPixels, whole - first, line);
    if (whole == done) continue;
    // The picture ends within the last group.
    std::array<Bgr, kPixels> rest{};
    std::copy(image_.row(y) + whole * kPixels, image_.row(y) + expected_->width, rest.begin());
    MeasureFrom(y, whole, rest.data(), 1, line);
  }
  RepeatEnds(line);
  // What is summed beyond the ends is judged nowhere.
  for (const PixelRun& run : closeup_->Measured(y)) SumAlong(run, line);
}

void DistortionScan::MeasureFrom(int y, int group, const Bgr* pixels, int count, Line& line) const {
  const int first = group * kPixels;
  MeasureGroups(expected_->Row(y) + group, pixels, count, gain_,
                {&line.alpha_shift[first + kPad],
                 {&line.cd[0][first + kPad], &line.cd[1][first + kPad], &line.cd[2][first + kPad]},
                 &line.cd_sq[first],
                 &line.alpha_weight[first],
                 &line.inverse_sigma[first]});
}

void DistortionScan::RepeatEnds(Line& line) const {
  const int width = expected_->width;
  for (auto* values : {&line.alpha_shift, &line.cd[0], &line.cd[1], &line.cd[2]}) {
    std::fill_n(values->begin(), kPad, (*values)[kPad]);
    std::fill_n(values->begin() + width + kPad, kPad, (*values)[width + kPad - 1]);
  }
}

void DistortionScan::SumAlong(const PixelRun& run, Line& line) {
  static_assert(kRadii_px[1] == kRadii_px[0] + 1 && kRadii_px[1] == kPad);
  const int count = run.end - run.begin;
  std::array<RowSums, kWindows> to;
  for (std::size_t w = 0; w < kWindows; ++w) {
    Sums& sums = line.sums[w];
    to[w] = {&sums.alpha[run.begin], &sums.alpha_sq[run.begin], &sums.moment[run.begin], {}};
    for (int c = 0; c < 3; ++c) to[w].cd[c] = &sums.cd[c][run.begin];
  }
  SumAlphas<SideOf(0)>(&line.alpha_shift[run.begin], count, to[0], to[1]);
  SumColors<SideOf(0)>({&line.cd[0][run.begin], &line.cd[1][run.begin], &line.cd[2][run.begin]},
                       count, to[0], to[1]);
}

template <std::size_t window>
void DistortionScan::SumDown(int y, const PixelRun& run) {
  constexpr int kSide = SideOf(window);
  const int count = run.end - run.begin;
  Column<kSide> a, q, m;
  std::array<Column<kSide>, 3> d;
  for (int i = 0; i < kSide; ++i) {
    const int row = std::clamp(y + i - kRadii_px[window], 0, expected_->height - 1);
    const Sums& sums = lines_[static_cast<std::size_t>(row % kLines)].sums[window];
    a[i] = &sums.alpha[run.begin];
    q[i] = &sums.alpha_sq[run.begin];
    m[i] = &sums.moment[run.begin];
    for (int c = 0; c < 3; ++c) d[c][i] = &sums.cd[c][run.begin];
  }
  const float* const alpha_weight =
      &lines_[static_cast<std::size_t>(y % kLines)].alpha_weight[run.begin];
  Results& results = results_[window];
  JoinAlphas<kSide>(a, q, m, alpha_weight, count, &results.alpha_shift[run.begin],
                    &results.roughness_sq[run.begin]);
  JoinColors<kSide>(d, count, &results.cd_sq[run.begin]);
}

}  // namespace mocap
