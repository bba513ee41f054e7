#include "core/reconstruction/distortion_scan.h"

#include <algorithm>
#include <cstddef>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr int kPad = DistortionScan::kRadius_px;
constexpr float kArea = 25;
// Sum of x² over the window's pixels, x = -2 .. 2.
constexpr float kSpread = 50;

void Repeat(std::vector<float>& padded, int width) {
  for (int i = 0; i < kPad; ++i) {
    padded[i] = padded[kPad];
    padded[kPad + width + i] = padded[kPad + width - 1];
  }
}

void Sum5(const float* padded, float* sum, int width) {
  for (int x = 0; x < width; ++x)
    sum[x] = padded[x] + padded[x + 1] + padded[x + 2] + padded[x + 3] + padded[x + 4];
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
    for (auto& sum : line.cd_sum) sum.resize(width);
    for (auto* values : {&line.cd_sq, &line.sum, &line.sum_sq, &line.slope}) values->resize(width);
  }
  for (auto& plane : color_) plane.resize(width);
  for (auto* values : {&window_alpha_shift_, &window_cd_sq_, &window_roughness_sq_})
    values->resize(width);
}

const DistortionScan::Line& DistortionScan::LineAt(int y) const {
  return lines_[static_cast<std::size_t>(std::clamp(y, 0, expected_->height - 1) % kSide)];
}

void DistortionScan::MeasurePixels(int y, Line& line) const {
  const int width = expected_->width;
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

void DistortionScan::SumAlong(Line& line) const {
  const int width = expected_->width;
  Repeat(line.alpha_shift, width);
  const float* const a = line.alpha_shift.data();
  float* const sum = line.sum.data();
  float* const sum_sq = line.sum_sq.data();
  float* const slope = line.slope.data();
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    sum[x] = a[x] + a[x + 1] + a[x + 2] + a[x + 3] + a[x + 4];
    sum_sq[x] = a[x] * a[x] + a[x + 1] * a[x + 1] + a[x + 2] * a[x + 2] + a[x + 3] * a[x + 3] +
                a[x + 4] * a[x + 4];
    slope[x] = 2 * (a[x + 4] - a[x]) + a[x + 3] - a[x + 1];
  }
  for (int c = 0; c < 3; ++c) {
    Repeat(line.cd[c], width);
    Sum5(line.cd[c].data(), line.cd_sum[c].data(), width);
  }
}

const DistortionScan::Row& DistortionScan::Next() {
  const int width = expected_->width;
  const int y = next_++;
  MOCAP_CHECK(y < expected_->height);
  for (; measured_ <= std::min(y + kRadius_px, expected_->height - 1); ++measured_) {
    const Bgr* const pixels = image_.row(measured_);
    for (int x = 0; x < width; ++x) {
      color_[0][x] = pixels[x].b * gain_;
      color_[1][x] = pixels[x].g * gain_;
      color_[2][x] = pixels[x].r * gain_;
    }
    Line& line = lines_[static_cast<std::size_t>(measured_ % kSide)];
    MeasurePixels(measured_, line);
    SumAlong(line);
  }
  const Line* const l[kSide] = {&LineAt(y - 2), &LineAt(y - 1), &LineAt(y), &LineAt(y + 1),
                                &LineAt(y + 2)};
  row_.alpha_shift = l[2]->alpha_shift.data() + kPad;
  row_.cd_sq = l[2]->cd_sq.data();
  row_.inverse_alpha_variation =
      expected_->inverse_alpha_variation.data() + static_cast<std::size_t>(y) * width;

  const float* const inverse_a = row_.inverse_alpha_variation;
  const float* const s[kSide] = {l[0]->sum.data(), l[1]->sum.data(), l[2]->sum.data(),
                                 l[3]->sum.data(), l[4]->sum.data()};
  const float* const q[kSide] = {l[0]->sum_sq.data(), l[1]->sum_sq.data(), l[2]->sum_sq.data(),
                                 l[3]->sum_sq.data(), l[4]->sum_sq.data()};
  const float* const g[kSide] = {l[0]->slope.data(), l[1]->slope.data(), l[2]->slope.data(),
                                 l[3]->slope.data(), l[4]->slope.data()};
  float* const mean = window_alpha_shift_.data();
  float* const roughness_sq = window_roughness_sq_.data();
#pragma GCC ivdep
  for (int x = 0; x < width; ++x) {
    const float sum = s[0][x] + s[1][x] + s[2][x] + s[3][x] + s[4][x];
    const float sum_sq = q[0][x] + q[1][x] + q[2][x] + q[3][x] + q[4][x];
    const float slope_x = g[0][x] + g[1][x] + g[2][x] + g[3][x] + g[4][x];
    const float slope_y = 2 * (s[4][x] - s[0][x]) + s[3][x] - s[1][x];
    const float variance =
        (sum_sq - sum * sum / kArea - (slope_x * slope_x + slope_y * slope_y) / kSpread) / kArea;
    mean[x] = sum / kArea;
    roughness_sq[x] = variance * inverse_a[x] * inverse_a[x];
  }
  float* const cd_sq = window_cd_sq_.data();
  std::fill(window_cd_sq_.begin(), window_cd_sq_.end(), 0.0f);
  for (int c = 0; c < 3; ++c) {
    const float* const r[kSide] = {l[0]->cd_sum[c].data(), l[1]->cd_sum[c].data(),
                                   l[2]->cd_sum[c].data(), l[3]->cd_sum[c].data(),
                                   l[4]->cd_sum[c].data()};
#pragma GCC ivdep
    for (int x = 0; x < width; ++x) {
      const float d = (r[0][x] + r[1][x] + r[2][x] + r[3][x] + r[4][x]) / kArea;
      cd_sq[x] += d * d;
    }
  }
  row_.window_alpha_shift = mean;
  row_.window_cd_sq = cd_sq;
  row_.window_roughness_sq = roughness_sq;
  return row_;
}

}  // namespace mocap
