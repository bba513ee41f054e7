#include "daemon/messages/reduced_picture.h"

#include <algorithm>

namespace mocap {
namespace {

Bgr MeanOf(ImageView<const Bgr> picture, int left, int top, int factor) {
  unsigned b = 0, g = 0, r = 0;
  for (int y = top; y < top + factor; ++y) {
    const Bgr* row = picture.row(y) + left;
    for (int x = 0; x < factor; ++x) {
      b += row[x].b;
      g += row[x].g;
      r += row[x].r;
    }
  }
  const auto count = static_cast<unsigned>(factor * factor);
  const auto mean = [count](unsigned sum) { return static_cast<std::uint8_t>(sum / count); };
  return {mean(b), mean(g), mean(r)};
}

bool IsCovered(const Silhouette& silhouette, int left, int top, int factor) {
  int covered = 0;
  for (int y = top; y < top + factor; ++y) {
    for (int x = left; x < left + factor; ++x) covered += silhouette.Test(x, y);
  }
  return 2 * covered >= factor * factor;
}

}  // namespace

int ReductionFor(int width_px, int widest_px) {
  return std::max(1, (width_px + widest_px - 1) / widest_px);
}

void ReducePicture(ImageView<const Bgr> picture, int factor, Image<Bgr>& reduced) {
  const int width = picture.width() / factor, height = picture.height() / factor;
  if (reduced.width() != width || reduced.height() != height) reduced = Image<Bgr>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      reduced(x, y) = MeanOf(picture, x * factor, y * factor, factor);
    }
  }
}

void ReduceSilhouette(const Silhouette& silhouette, int factor, std::vector<std::int32_t>& runs) {
  const int width = silhouette.width() / factor, height = silhouette.height() / factor;
  runs.assign(1, 0);
  bool was_covered = false;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_covered = IsCovered(silhouette, x * factor, y * factor, factor);
      if (is_covered != was_covered) runs.push_back(0);
      was_covered = is_covered;
      ++runs.back();
    }
  }
}

Silhouette SilhouetteFromRuns(const std::vector<std::int32_t>& runs, int width, int height) {
  Silhouette silhouette(width, height);
  const std::int64_t pixels = std::int64_t{width} * height;
  std::int64_t at = 0;
  for (std::size_t i = 0; i < runs.size() && at < pixels; ++i) {
    const std::int64_t end = std::min(pixels, at + std::max(0, runs[i]));
    for (; i % 2 == 1 && at < end; ++at) {
      silhouette.Set(static_cast<int>(at % width), static_cast<int>(at / width));
    }
    at = end;
  }
  return silhouette;
}

}  // namespace mocap
