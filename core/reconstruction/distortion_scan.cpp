#include "core/reconstruction/distortion_scan.h"

#include <algorithm>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

// The sum of f(0) + … + f(count − 1), written out, so that loops around it are vectorized.
template <int count, typename Function>
inline float Sum(Function f) {
  return [&]<int... i>(std::integer_sequence<int, i...>) { return (f(i) + ...); }
  (std::make_integer_sequence<int, count>{});
}

constexpr int SideOf(std::size_t window) { return 2 * DistortionScan::kRadii_px[window] + 1; }

void RepeatEnds(std::vector<float>& padded, int width, int pad) {
  for (int i = 0; i < pad; ++i) {
    padded[i] = padded[pad];
    padded[pad + width + i] = padded[pad + width - 1];
  }
}

}  // namespace

void DistortionScan::Begin(const ExpectedPicture& expected, ImageView<const Bgr> image,
                           float gain) {
  MOCAP_CHECK(image.width() == expected.width && image.height() == expected.height);
  expected_ = &expected;
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
  for (; measured_ <= std::min(y + kPad, expected_->height - 1); ++measured_) {
    Line& line = lines_[static_cast<std::size_t>(measured_ % kLines)];
    MeasurePixels(measured_, line);
    RepeatEnds(line.alpha_shift, expected_->width, kPad);
    for (auto& cd : line.cd) RepeatEnds(cd, expected_->width, kPad);
    SumAlong<0>(line);
    SumAlong<1>(line);
  }
  SumDown<0>(y);
  SumDown<1>(y);
  const Line& line = lines_[static_cast<std::size_t>(y % kLines)];
  row_.alpha_shift = line.alpha_shift.data() + kPad;
  row_.cd_sq = line.cd_sq.data();
  row_.inverse_alpha_variation =
      expected_->inverse_alpha_variation.data() + static_cast<std::size_t>(y) * expected_->width;
  for (std::size_t w = 0; w < kWindows; ++w)
    row_.windows[w] = {results_[w].alpha_shift.data(), results_[w].cd_sq.data(),
                       results_[w].roughness_sq.data()};
  return row_;
}

void DistortionScan::MeasurePixels(int y, Line& line) {
  const int width = expected_->width;
  const Bgr* const pixels = image_.row(y);
  for (int x = 0; x < width; ++x) {
    color_[0][x] = pixels[x].b * gain_;
    color_[1][x] = pixels[x].g * gain_;
    color_[2][x] = pixels[x].r * gain_;
  }
  const std::size_t begin = static_cast<std::size_t>(y) * width;
  const float* const m0 = expected_->scaled_mean[0].data() + begin;
  const float* const m1 = expected_->scaled_mean[1].data() + begin;
  const float* const m2 = expected_->scaled_mean[2].data() + begin;
  const float* const w0 = expected_->inverse_sigma[0].data() + begin;
  const float* const w1 = expected_->inverse_sigma[1].data() + begin;
  const float* const w2 = expected_->inverse_sigma[2].data() + begin;
  const float* const c0 = color_[0].data();
  const float* const c1 = color_[1].data();
  const float* const c2 = color_[2].data();
  float* const alpha_shift = line.alpha_shift.data() + kPad;
  float* const d0 = line.cd[0].data() + kPad;
  float* const d1 = line.cd[1].data() + kPad;
  float* const d2 = line.cd[2].data() + kPad;
  float* const cd_sq = line.cd_sq.data();
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float z0 = c0[x] * w0[x];
    const float z1 = c1[x] * w1[x];
    const float z2 = c2[x] * w2[x];
    const float alpha =
        (z0 * m0[x] + z1 * m1[x] + z2 * m2[x]) / (m0[x] * m0[x] + m1[x] * m1[x] + m2[x] * m2[x]);
    const float e0 = z0 - alpha * m0[x];
    const float e1 = z1 - alpha * m1[x];
    const float e2 = z2 - alpha * m2[x];
    alpha_shift[x] = alpha - 1;
    d0[x] = e0;
    d1[x] = e1;
    d2[x] = e2;
    cd_sq[x] = e0 * e0 + e1 * e1 + e2 * e2;
  }
}

template <std::size_t window>
void DistortionScan::SumAlong(Line& line) const {
  constexpr int kSide = SideOf(window);
  constexpr int kRadius = kRadii_px[window];
  const int width = expected_->width;
  Sums& sums = line.sums[window];
  const float* const a = line.alpha_shift.data() + kPad - kRadius;
  float* const alpha = sums.alpha.data();
  float* const alpha_sq = sums.alpha_sq.data();
  float* const moment = sums.moment.data();
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    alpha[x] = Sum<kSide>([&](int i) { return a[x + i]; });
    alpha_sq[x] = Sum<kSide>([&](int i) { return a[x + i] * a[x + i]; });
    moment[x] = Sum<kSide>([&](int i) { return static_cast<float>(i - kRadius) * a[x + i]; });
  }
  for (int c = 0; c < 3; ++c) {
    const float* const d = line.cd[c].data() + kPad - kRadius;
    float* const cd = sums.cd[c].data();
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) cd[x] = Sum<kSide>([&](int i) { return d[x + i]; });
  }
}

template <std::size_t window>
void DistortionScan::SumDown(int y) {
  constexpr int kSide = SideOf(window);
  constexpr int kRadius = kRadii_px[window];
  constexpr float kArea = kSide * kSide;
  // Sum of x² over the window's pixels, counted from its middle.
  constexpr float kSpread = kArea * (kArea - 1) / 12;
  const int width = expected_->width;
  std::array<const float*, kSide> a, q, m;
  std::array<std::array<const float*, kSide>, 3> d;
  for (int i = 0; i < kSide; ++i) {
    const int row = std::clamp(y + i - kRadius, 0, expected_->height - 1);
    const Sums& sums = lines_[static_cast<std::size_t>(row % kLines)].sums[window];
    a[i] = sums.alpha.data();
    q[i] = sums.alpha_sq.data();
    m[i] = sums.moment.data();
    for (int c = 0; c < 3; ++c) d[c][i] = sums.cd[c].data();
  }
  const float* const inverse_a =
      expected_->inverse_alpha_variation.data() + static_cast<std::size_t>(y) * width;
  float* const alpha_shift = results_[window].alpha_shift.data();
  float* const roughness_sq = results_[window].roughness_sq.data();
  float* const cd_sq = results_[window].cd_sq.data();
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float sum = Sum<kSide>([&](int i) { return a[i][x]; });
    const float sum_sq = Sum<kSide>([&](int i) { return q[i][x]; });
    const float along = Sum<kSide>([&](int i) { return m[i][x]; });
    const float down = Sum<kSide>([&](int i) { return static_cast<float>(i - kRadius) * a[i][x]; });
    const float variance =
        (sum_sq - sum * sum / kArea - (along * along + down * down) / kSpread) / kArea;
    alpha_shift[x] = sum / kArea;
    roughness_sq[x] = variance * inverse_a[x] * inverse_a[x];
  }
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float d0 = Sum<kSide>([&](int i) { return d[0][i][x]; });
    const float d1 = Sum<kSide>([&](int i) { return d[1][i][x]; });
    const float d2 = Sum<kSide>([&](int i) { return d[2][i][x]; });
    cd_sq[x] = (d0 * d0 + d1 * d1 + d2 * d2) / (kArea * kArea);
  }
}

}  // namespace mocap
