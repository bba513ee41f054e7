#include "core/reconstruction/distortion_scan.h"

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

MOCAP_VECTORIZED
void Separate(const Bgr* pixels, int count, const std::array<float, 3>& gain, float* b, float* g,
              float* r) {
  const float gain0 = gain[0], gain1 = gain[1], gain2 = gain[2];
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    b[x] = pixels[x].b * gain0;
    g[x] = pixels[x].g * gain1;
    r[x] = pixels[x].r * gain2;
  }
}

struct Pixels {
  std::array<const float*, 3> color, mean, inverse_sigma;
  const float* inverse_square;
};
struct Distortions {
  float* alpha_shift;
  std::array<float*, 3> cd;
  float* cd_sq;
};

MOCAP_VECTORIZED
void MeasurePixels(const Pixels& p, int count, const Distortions& d) {
  const auto [c0, c1, c2] = p.color;
  const auto [e0, e1, e2] = p.mean;
  const auto [w0, w1, w2] = p.inverse_sigma;
  const auto [d0, d1, d2] = d.cd;
  const float* const inverse_square = p.inverse_square;
  float *const alpha_shift = d.alpha_shift, *const cd_sq = d.cd_sq;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float m0 = e0[x] * w0[x], m1 = e1[x] * w1[x], m2 = e2[x] * w2[x];
    const float z0 = c0[x] * w0[x], z1 = c1[x] * w1[x], z2 = c2[x] * w2[x];
    const float alpha = (z0 * m0 + z1 * m1 + z2 * m2) * inverse_square[x];
    const float f0 = z0 - alpha * m0;
    const float f1 = z1 - alpha * m1;
    const float f2 = z2 - alpha * m2;
    alpha_shift[x] = alpha - 1;
    d0[x] = f0;
    d1[x] = f1;
    d2[x] = f2;
    cd_sq[x] = f0 * f0 + f1 * f1 + f2 * f2;
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
  const auto width = static_cast<std::size_t>(expected.width);
  for (Line& line : lines_) {
    line.alpha_shift.resize(width + 2 * kPad);
    for (auto& cd : line.cd) cd.resize(width + 2 * kPad);
    line.cd_sq.resize(width);
    for (Sums& sums : line.sums) {
      for (auto* values : {&sums.alpha, &sums.alpha_sq, &sums.moment}) values->resize(width);
      for (auto& cd : sums.cd) cd.resize(width);
    }
  }
  for (auto& plane : color_) plane.resize(width);
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
  row_.alpha_weight =
      expected_->alpha_weight.data() + static_cast<std::size_t>(y) * expected_->width;
  for (std::size_t w = 0; w < kWindows; ++w)
    row_.windows[w] = {results_[w].alpha_shift.data(), results_[w].cd_sq.data(),
                       results_[w].roughness_sq.data()};
  return row_;
}

void DistortionScan::Measure(int y, Line& line) {
  const Bgr* const pixels = image_.row(y);
  const std::size_t begin = static_cast<std::size_t>(y) * expected_->width;
  for (const PixelRun& run : closeup_->Measured(y)) {
    const int count = run.end - run.begin;
    const std::size_t i = begin + run.begin;
    Separate(pixels + run.begin, count, gain_, color_[0].data(), color_[1].data(),
             color_[2].data());
    Pixels from{{}, {}, {}, &expected_->inverse_square[i]};
    Distortions to{&line.alpha_shift[run.begin + kPad], {}, &line.cd_sq[run.begin]};
    for (int c = 0; c < 3; ++c) {
      from.color[c] = color_[c].data();
      from.mean[c] = &expected_->mean[c][i];
      from.inverse_sigma[c] = &expected_->inverse_sigma[c][i];
      to.cd[c] = &line.cd[c][run.begin + kPad];
    }
    MeasurePixels(from, count, to);
  }
  RepeatEnds(line);
  // What is summed beyond the ends is judged nowhere.
  for (const PixelRun& run : closeup_->Measured(y)) {
    SumAlong(run, line);
  }
}

void DistortionScan::RepeatEnds(Line& line) const {
  const int width = expected_->width;
  for (auto* values : {&line.alpha_shift, &line.cd[0], &line.cd[1], &line.cd[2]}) {
    std::fill_n(values->begin(), kPad, (*values)[kPad]);
    std::fill_n(values->end() - kPad, kPad, (*values)[width + kPad - 1]);
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
      &expected_->alpha_weight[static_cast<std::size_t>(y) * expected_->width + run.begin];
  Results& results = results_[window];
  JoinAlphas<kSide>(a, q, m, alpha_weight, count, &results.alpha_shift[run.begin],
                    &results.roughness_sq[run.begin]);
  JoinColors<kSide>(d, count, &results.cd_sq[run.begin]);
}

}  // namespace mocap
