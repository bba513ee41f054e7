#include "core/reconstruction/background/expected_picture.h"

#include <algorithm>
#include <cmath>

#include "core/kernels/expected_pixels.h"
#include "core/kernels/mixing.h"

namespace mocap {
namespace {

constexpr int kPixels = WeighedPixels::kPixels;

}  // namespace

ExpectedPicture::ExpectedPicture(int picture_width, int picture_height)
    : width(picture_width),
      height(picture_height),
      weighed_(static_cast<std::size_t>((picture_width + kPixels - 1) / kPixels) * picture_height) {
  // Whole groups are weighed.
  const std::size_t size = static_cast<std::size_t>(width) * height + kPixels;
  for (auto& plane : mean) plane.resize(size, 255);
  for (auto& plane : variance) plane.resize(size, kUnknownVariance);
  slope.resize(size);
}

void ExpectedPicture::SetPixel(std::size_t i, const std::array<float, 3>& color,
                               const std::array<float, 3>& sigma) {
  for (int c = 0; c < 3; ++c) {
    mean[c][i] = std::max(color[c], kDarkestMean);
    variance[c][i] = sigma[c] * sigma[c];
  }
}

void ExpectedPicture::Weigh(float shift_px, int y, int begin, int end) {
  const int group = begin / kPixels;
  const int groups = (end + kPixels - 1) / kPixels - group;
  const std::size_t first = static_cast<std::size_t>(y) * width + group * kPixels;
  kernels::WeighedFrom from{{}, {}, &slope[first]};
  for (int c = 0; c < 3; ++c) {
    from.mean[c] = &mean[c][first];
    from.variance[c] = &variance[c][first];
  }
  kernels::WeighPixels(from, groups, shift_px * shift_px,
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
    kernels::MixNeighbours(&from.mean[c][top], &from.mean[c][top + width], count, a, b,
                           &mean[c][line + first]);
    std::copy_n(&from.variance[c][nearest], count, &variance[c][line + first]);
  }
  std::copy_n(&from.slope[nearest], count, &slope[line + first]);
}

}  // namespace mocap
