#include "core/reconstruction/distance_map.h"

#include <initializer_list>

namespace mocap {
namespace {

// A distance grows by one a step; `sign` keeps the two kinds apart.
std::int8_t Step(std::int8_t here, int sign, std::initializer_list<std::int8_t> neighbours) {
  int distance = sign * here;
  for (const std::int8_t n : neighbours) distance = std::min(distance, std::max(sign * n, 0) + 1);
  return static_cast<std::int8_t>(sign * distance);
}

}  // namespace

void DistanceMap::Measure(const Silhouette& silhouette) {
  const std::optional<PixelBox> box = silhouette.BoundingBox();
  const PixelBox b = box.value_or(PixelBox{0, 0, -1, -1});
  left_ = b.left, top_ = b.top, right_ = b.right, bottom_ = b.bottom;
  const int width = right_ - left_ + 1;
  const int height = bottom_ - top_ + 1;
  stride_ = width + 2;
  // The margin is outside the silhouette: next to what is inside, far from what is outside.
  cells_.assign(static_cast<std::size_t>(stride_) * (height + 2), -kFarthest);
  for (int y = 0; y < height; ++y) {
    std::int8_t* row = &cells_[static_cast<std::size_t>(y + 1) * stride_ + 1];
    for (int x = 0; x < width; ++x)
      row[x] =
          static_cast<std::int8_t>(silhouette.Test(left_ + x, top_ + y) ? kFarthest : -kFarthest);
  }
  const int s = stride_;
  for (int y = 0; y < height; ++y) {
    std::int8_t* c = &cells_[static_cast<std::size_t>(y + 1) * s + 1];
    for (int x = 0; x < width; ++x, ++c)
      *c = Step(*c, *c > 0 ? 1 : -1, {c[-1], c[-s - 1], c[-s], c[-s + 1]});
  }
  for (int y = height - 1; y >= 0; --y) {
    std::int8_t* c = &cells_[static_cast<std::size_t>(y + 1) * s + width];
    for (int x = width - 1; x >= 0; --x, --c)
      *c = Step(*c, *c > 0 ? 1 : -1, {c[1], c[s + 1], c[s], c[s - 1]});
  }
}

}  // namespace mocap
