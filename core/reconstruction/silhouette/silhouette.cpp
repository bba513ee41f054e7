#include "core/reconstruction/silhouette/silhouette.h"

#include <algorithm>
#include <bit>

#include "core/kernels/bits.h"

namespace mocap {
std::optional<PixelBox> Silhouette::FindBox() const {
  const auto is_empty = [](std::uint64_t word) { return word == 0; };
  const auto first = std::find_if_not(words_.begin(), words_.end(), is_empty);
  if (first == words_.end()) return std::nullopt;
  const auto last = std::find_if_not(words_.rbegin(), words_.rend(), is_empty).base() - 1;
  PixelBox box;
  box.top = static_cast<int>(first - words_.begin()) / words_per_row_;
  box.bottom = static_cast<int>(last - words_.begin()) / words_per_row_;
  const auto column = [&](int i) {
    std::uint64_t any = 0;
    for (int y = box.top; y <= box.bottom; ++y) any |= row(y)[i];
    return any;
  };
  int i = 0;
  std::uint64_t any = column(i);
  while (any == 0) any = column(++i);
  box.left = i * 64 + std::countr_zero(any);
  i = words_per_row_ - 1;
  any = column(i);
  while (any == 0) any = column(--i);
  box.right = i * 64 + 63 - std::countl_zero(any);
  return box;
}

double Silhouette::CoveredShare() const {
  if (width_ == 0 || height_ == 0) return 0;
  const std::int64_t count = kernels::CountBits(words_.data(), words_.size());
  return static_cast<double>(count) / (static_cast<double>(width_) * height_);
}

}  // namespace mocap
