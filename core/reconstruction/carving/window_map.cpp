#include "core/reconstruction/carving/window_map.h"

#include <algorithm>

#include "core/kernels/bit_columns.h"

namespace mocap {
namespace {

using Word = kernels::ColumnWord;
constexpr int kBits = 32;

// Bits [begin, begin + 32) of a row; zeros beyond its end.
Word BitsAt(const std::uint64_t* row, int words, int begin) {
  const int i = begin >> 6, shift = begin & 63;
  std::uint64_t bits = i < words ? row[i] >> shift : 0;
  if (shift > kBits && i + 1 < words) bits |= row[i + 1] << (64 - shift);
  return static_cast<Word>(bits);
}

}  // namespace

void WindowMap::Measure(const Silhouette& silhouette, const Silhouette* unknown,
                        const PixelBox& box) {
  width_px_ = silhouette.width();
  height_px_ = silhouette.height();
  left_ = box.left;
  right_ = box.right;
  top_ = box.top;
  bottom_ = box.bottom;
  rows_ = bottom_ - top_ + 1;
  columns_ = (right_ - left_) / kBits + 1;
  Extract(silhouette, inside_);
  outside_ = inside_;
  if (unknown && unknown->BoundingBox()) {
    Extract(*unknown, unknown_);
    for (std::size_t i = 0; i < outside_.size(); ++i) outside_[i] |= unknown_[i];
  }
  for (Word& word : outside_) word = ~word;
  WritePlanes();
}

// The columns left and right of the region, and what lies right of it in the last one, are empty.
void WindowMap::Extract(const Silhouette& silhouette, Bits& bits) const {
  bits.assign(static_cast<std::size_t>(rows_) * (columns_ + 2), 0);
  const int last_bits = (right_ - left_) % kBits + 1;
  const Word within = ~Word{0} >> (kBits - last_bits);
  for (int i = 0; i < columns_; ++i) {
    Word* const to = Column(bits, i) - top_;
    const Word kept = i + 1 < columns_ ? ~Word{0} : within;
    for (int y = top_; y <= bottom_; ++y)
      to[y] = BitsAt(silhouette.row(y), silhouette.words_per_row(), left_ + i * kBits) & kept;
  }
}

void WindowMap::WritePlanes() {
  const std::size_t words = static_cast<std::size_t>(2) * columns_ * rows_;
  planes_.resize(words * kPlanes);
  for (int plane = 0; plane < kPlanes; ++plane) {
    if (plane > 0) Grow(1 << (plane - 1));
    for (int i = 0; i < columns_; ++i) {
      Word* const to = &planes_[words * plane + static_cast<std::size_t>(2) * i * rows_];
      kernels::JoinInsideAndOutside(Column(inside_, i), Column(outside_, i), rows_, to, to + rows_);
    }
  }
}

// Enlarges windows by `step`.
void WindowMap::Grow(int step) {
  for (Bits* const bits : {&inside_, &outside_}) {
    kernels::WidenWindows(Column(*bits, 0), columns_ * rows_, rows_, step);
    kernels::HeightenWindows(Column(*bits, 0), columns_, rows_, rows_, step);
  }
  // Nothing below the region is inside.
  const int lowest = std::min(step, rows_);
  for (int i = 0; i < columns_; ++i) std::fill_n(Column(inside_, i) + rows_ - lowest, lowest, 0);
}

}  // namespace mocap
