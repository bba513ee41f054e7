#include "core/reconstruction/background/expected_picture.h"

#include <algorithm>
#include <cmath>

#include "core/vectorized.h"

namespace mocap {
namespace {

constexpr float kNoLimit = 1e6f;

struct Source {
  std::array<const float*, 3> mean, variance;
  const float* alpha_limit;
  const std::uint8_t* slope;
};
constexpr int kPixels = WeighedPixels::kPixels;

inline std::uint16_t Rounded(float value) {
  return static_cast<std::uint16_t>(static_cast<int>(std::min(value, 65535.0f) + 0.5f));
}

MOCAP_VECTORIZED
void WeighGroups(const Source& from, int groups, float shift_sq, WeighedPixels* to, int stride) {
  const auto [e0, e1, e2] = from.mean;
  const auto [v0, v1, v2] = from.variance;
  const float* const alpha_limit = from.alpha_limit;
  const std::uint8_t* const slopes = from.slope;
  for (int g = 0; g < groups; ++g) {
    WeighedPixels& group = to[static_cast<std::ptrdiff_t>(g) * stride];
    const int first = g * kPixels;
#pragma GCC ivdep
    for (int k = 0; k < kPixels; ++k) {
      const int x = first + k;
      const float slope = slopes[x];
      const float more = shift_sq * slope * slope;
      const float i0 = 1 / (v0[x] + more), i1 = 1 / (v1[x] + more), i2 = 1 / (v2[x] + more);
      const float square = e0[x] * e0[x] * i0 + e1[x] * e1[x] * i1 + e2[x] * e2[x] * i2;
      const float alpha_weight = std::min(std::sqrt(square), alpha_limit[x]);
      group.mean[0][k] = Rounded(e0[x] / WeighedPixels::kMeanUnit);
      group.mean[1][k] = Rounded(e1[x] / WeighedPixels::kMeanUnit);
      group.mean[2][k] = Rounded(e2[x] / WeighedPixels::kMeanUnit);
      group.inverse_sigma[0][k] = Rounded(std::sqrt(i0) / WeighedPixels::kInverseSigmaUnit);
      group.inverse_sigma[1][k] = Rounded(std::sqrt(i1) / WeighedPixels::kInverseSigmaUnit);
      group.inverse_sigma[2][k] = Rounded(std::sqrt(i2) / WeighedPixels::kInverseSigmaUnit);
      group.alpha_weight[k] = Rounded(alpha_weight / WeighedPixels::kAlphaWeightUnit);
    }
  }
}

// Interpolates between pixels and their right and lower neighbours.
MOCAP_VECTORIZED
void MixPixels(const float* top, const float* bottom, int count, float a, float b, float* to) {
  const float w0 = (1 - a) * (1 - b), w1 = a * (1 - b), w2 = (1 - a) * b, w3 = a * b;
#pragma GCC ivdep
  for (int x = 0; x < count; ++x)
    to[x] = w0 * top[x] + w1 * top[x + 1] + w2 * bottom[x] + w3 * bottom[x + 1];
}

}  // namespace

ExpectedPicture::ExpectedPicture(int picture_width, int picture_height)
    : width(picture_width),
      height(picture_height),
      weighed_(static_cast<std::size_t>((picture_width + kPixels - 1) / kPixels) * picture_height) {
  // Whole groups are weighed.
  const std::size_t size = static_cast<std::size_t>(width) * height + kPixels;
  for (auto& plane : mean) plane.resize(size, 255);
  for (auto& plane : variance) plane.resize(size, kUnknownVariance);
  alpha_limit.resize(size, kNoLimit);
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

void ExpectedPicture::Weigh(float shift_px, int y, int begin, int end) {
  const int group = begin / kPixels;
  const int groups = (end + kPixels - 1) / kPixels - group;
  const std::size_t first = static_cast<std::size_t>(y) * width + group * kPixels;
  Source from{{}, {}, &alpha_limit[first], &slope[first]};
  for (int c = 0; c < 3; ++c) {
    from.mean[c] = &mean[c][first];
    from.variance[c] = &variance[c][first];
  }
  WeighGroups(from, groups, shift_px * shift_px,
              &weighed_[static_cast<std::size_t>(group) * height + y], height);
}

void ExpectedPicture::Displace(const ExpectedPicture& from, const Displacement& displacement, int y,
                               int begin, int end) {
  // Nothing is known beyond the edge.
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
    alpha_limit[line + x] = kNoLimit;
    slope[line + x] = 0;
  };
  for (int x = begin; x < first; ++x) forget(x);
  for (int x = last; x < end; ++x) forget(x);
  if (first == last) return;
  const std::size_t top = static_cast<std::size_t>(row) * width + first + shift;
  // Variations are the nearest pixel's.
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
