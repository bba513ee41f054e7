#include "core/reconstruction/silhouette/silhouette.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/vectorized.h"

namespace mocap {
namespace {

MOCAP_VECTORIZED
std::int64_t CountBits(const std::uint64_t* words, std::size_t count) {
  std::int64_t bits = 0;
  for (std::size_t i = 0; i < count; ++i) bits += std::popcount(words[i]);
  return bits;
}

// How many words from one on, or back from one when `step` is −1, are empty.
MOCAP_VECTORIZED
std::size_t CountEmpty(const std::uint64_t* words, std::size_t count, int step) {
  constexpr std::ptrdiff_t kAtOnce = 32;
  const auto end = static_cast<std::ptrdiff_t>(count);
  std::ptrdiff_t i = 0;
  for (; i + kAtOnce <= end; i += kAtOnce) {
    const std::uint64_t* const some = step > 0 ? words + i : words - i - (kAtOnce - 1);
    std::uint64_t any = 0;
    for (std::ptrdiff_t k = 0; k < kAtOnce; ++k) any |= some[k];
    if (any != 0) break;
  }
  while (i < end && words[i * step] == 0) ++i;
  return static_cast<std::size_t>(i);
}

// So many columns of words lie in a cache line.
constexpr int kColumns = 8;

// Unites rows of `count` words, `stride` apart.
MOCAP_VECTORIZED
void UniteRows(const std::uint64_t* words, int rows, int stride, int count, std::uint64_t* united) {
  for (int y = 0; y < rows; ++y, words += stride) {
    if (count == kColumns)
      for (int i = 0; i < kColumns; ++i) united[i] |= words[i];
    else
      for (int i = 0; i < count; ++i) united[i] |= words[i];
  }
}

}  // namespace

std::optional<PixelBox> Silhouette::FindBox() const {
  const std::size_t first = CountEmpty(words_.data(), words_.size(), 1);
  if (first == words_.size()) return std::nullopt;
  const std::size_t after = words_.size() - CountEmpty(&words_.back(), words_.size(), -1);
  PixelBox box;
  box.top = static_cast<int>(first) / words_per_row_;
  box.bottom = static_cast<int>(after - 1) / words_per_row_;
  box.left = width_;
  for (int begin = 0; begin < words_per_row_; begin += kColumns) {
    std::array<std::uint64_t, kColumns> columns{};
    const int count = std::min(kColumns, words_per_row_ - begin);
    UniteRows(row(box.top) + begin, box.bottom - box.top + 1, words_per_row_, count,
              columns.data());
    for (int i = 0; i < count; ++i) {
      if (columns[i] == 0) continue;
      const int x = (begin + i) * 64;
      box.left = std::min(box.left, x + std::countr_zero(columns[i]));
      box.right = x + 63 - std::countl_zero(columns[i]);
    }
  }
  return box;
}

double Silhouette::CoveredShare() const {
  if (width_ == 0 || height_ == 0) return 0;
  const std::int64_t count = CountBits(words_.data(), words_.size());
  return static_cast<double>(count) / (static_cast<double>(width_) * height_);
}

}  // namespace mocap
