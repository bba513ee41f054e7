#include "core/reconstruction/expected_picture.h"

#include <algorithm>
#include <cmath>

#include "core/vectorized.h"

namespace mocap {
namespace {

struct Source {
  std::array<const float*, 3> mean, variance;
  const float* alpha_limit;
  const std::uint8_t* slope;
};
struct Weights {
  std::array<float*, 3> inverse_sigma;
  float *inverse_square, *alpha_weight;
};

MOCAP_VECTORIZED
void WeighPixels(const Source& from, int count, float shift_sq, const Weights& to) {
  const auto [e0, e1, e2] = from.mean;
  const auto [v0, v1, v2] = from.variance;
  const auto [w0, w1, w2] = to.inverse_sigma;
  const float* const alpha_limit = from.alpha_limit;
  const std::uint8_t* const slopes = from.slope;
  float *const inverse_square = to.inverse_square, *const alpha_weight = to.alpha_weight;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x) {
    const float slope = slopes[x];
    const float more = shift_sq * slope * slope;
    const float i0 = 1 / (v0[x] + more), i1 = 1 / (v1[x] + more), i2 = 1 / (v2[x] + more);
    const float square = e0[x] * e0[x] * i0 + e1[x] * e1[x] * i1 + e2[x] * e2[x] * i2;
    w0[x] = std::sqrt(i0);
    w1[x] = std::sqrt(i1);
    w2[x] = std::sqrt(i2);
    inverse_square[x] = 1 / square;
    alpha_weight[x] = std::min(std::sqrt(square), alpha_limit[x]);
  }
}

// Mixes pixels with their right and lower neighbours.
MOCAP_VECTORIZED
void MixPixels(const float* top, const float* bottom, int count, float a, float b, float* to) {
  const float w0 = (1 - a) * (1 - b), w1 = a * (1 - b), w2 = (1 - a) * b, w3 = a * b;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    to[x] = w0 * top[x] + w1 * top[x + 1] + w2 * bottom[x] + w3 * bottom[x + 1];
}

}  // namespace

ExpectedPicture::ExpectedPicture(int picture_width, int picture_height)
    : width(picture_width), height(picture_height) {
  const std::size_t size = static_cast<std::size_t>(width) * height;
  for (auto* planes : {&mean, &variance, &inverse_sigma})
    for (auto& plane : *planes) plane.resize(size);
  for (auto* plane : {&alpha_limit, &inverse_square, &alpha_weight}) plane->resize(size);
  slope.resize(size);
}

void ExpectedPicture::SetPixel(std::size_t i, const std::array<float, 3>& color,
                               const std::array<float, 3>& sigma, float alpha_variation) {
  for (int c = 0; c < 3; ++c) {
    mean[c][i] = std::max(color[c], kDarkestMean);
    variance[c][i] = sigma[c] * sigma[c];
  }
  alpha_limit[i] = 1 / std::max(alpha_variation, 1e-6f);
}

void ExpectedPicture::Weigh(float shift_px, std::size_t begin, int count) {
  Source from{{}, {}, &alpha_limit[begin], &slope[begin]};
  Weights to{{}, &inverse_square[begin], &alpha_weight[begin]};
  for (int c = 0; c < 3; ++c) {
    from.mean[c] = &mean[c][begin];
    from.variance[c] = &variance[c][begin];
    to.inverse_sigma[c] = &inverse_sigma[c][begin];
  }
  WeighPixels(from, count, shift_px * shift_px, to);
}

void ExpectedPicture::Displace(const ExpectedPicture& from, const Displacement& displacement, int y,
                               int begin, int end) {
  // Beyond the edge, where nothing is known.
  const float from_y = static_cast<float>(y) - displacement.y_px;
  const float dx = std::floor(-displacement.x_px), dy = std::floor(from_y);
  const float a = -displacement.x_px - dx, b = from_y - dy;
  const int shift = static_cast<int>(dx), row = static_cast<int>(dy);
  const bool has_row = row >= 0 && row + 1 < height;
  const int first = has_row ? std::clamp(-shift, begin, end) : end;
  const int last = has_row ? std::clamp(width - 1 - shift, first, end) : end;
  const std::size_t line = static_cast<std::size_t>(y) * width;
  const auto forget = [&](int x) {
    for (int c = 0; c < 3; ++c) mean[c][line + x] = 255, variance[c][line + x] = kUnknownVariance;
    alpha_limit[line + x] = 1e6f;
    slope[line + x] = 0;
  };
  for (int x = begin; x < first; ++x) forget(x);
  for (int x = last; x < end; ++x) forget(x);
  if (first == last) return;
  const std::size_t top = static_cast<std::size_t>(row) * width + first + shift;
  // Of variations the nearest do.
  const std::size_t nearest = top + (a > 0.5f ? 1 : 0) + (b > 0.5f ? width : 0);
  const int count = last - first;
  for (int c = 0; c < 3; ++c) {
    MixPixels(&from.mean[c][top], &from.mean[c][top + width], count, a, b, &mean[c][line + first]);
    std::copy_n(&from.variance[c][nearest], count, &variance[c][line + first]);
  }
  std::copy_n(&from.alpha_limit[nearest], count, &alpha_limit[line + first]);
  std::copy_n(&from.slope[nearest], count, &slope[line + first]);
}

}  // namespace mocap
