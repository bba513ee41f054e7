#include "core/reconstruction/silhouette/silhouette.h"

#include <algorithm>
#include <bit>

namespace mocap {

std::optional<PixelBox> Silhouette::BoundingBox() const {
  PixelBox box{width_, height_, -1, -1};
  for (int y = 0; y < height_; ++y) {
    const std::uint64_t* words = row(y);
    int first = 0;
    while (first < words_per_row_ && words[first] == 0) ++first;
    if (first == words_per_row_) continue;
    int last = words_per_row_ - 1;
    while (words[last] == 0) --last;
    box.left = std::min(box.left, first * 64 + std::countr_zero(words[first]));
    box.right = std::max(box.right, last * 64 + 63 - std::countl_zero(words[last]));
    box.top = std::min(box.top, y);
    box.bottom = y;
  }
  if (box.bottom < 0) return std::nullopt;
  return box;
}

double Silhouette::CoveredShare() const {
  if (width_ == 0 || height_ == 0) return 0;
  std::int64_t count = 0;
  for (const std::uint64_t word : words_) count += std::popcount(word);
  return static_cast<double>(count) / (static_cast<double>(width_) * height_);
}

}  // namespace mocap
