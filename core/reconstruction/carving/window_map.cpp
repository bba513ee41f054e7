#include "core/reconstruction/carving/window_map.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/kernels/bit_columns.h"

namespace mocap {
namespace {

using Word = kernels::ColumnWord;
constexpr int kBits = 32;
// Applied one after another, they dilate or erode by the width of a gap.
constexpr std::array<int, 3> kGapSteps_px = {1, 2, 3};
static_assert(kGapSteps_px[0] + kGapSteps_px[1] + kGapSteps_px[2] == WindowMap::kGap_px);

// Bits [begin, begin + 32) of a row; zeros beyond its end.
Word BitsAt(const std::uint64_t* row, int words, int begin) {
  const int i = begin >> 6, shift = begin & 63;
  std::uint64_t bits = i < words ? row[i] >> shift : 0;
  if (shift > kBits && i + 1 < words) bits |= row[i + 1] << (64 - shift);
  return static_cast<Word>(bits);
}

}  // namespace

void WindowMap::Measure(const Silhouette& silhouette, const PixelBox& box, bool closes_gaps) {
  const int margin = closes_gaps ? kGap_px : 0;
  width_px_ = silhouette.width();
  height_px_ = silhouette.height();
  left_ = std::max(box.left - margin, 0);
  right_ = std::min(box.right + margin, width_px_ - 1);
  top_ = std::max(box.top - margin, 0);
  bottom_ = std::min(box.bottom + margin, height_px_ - 1);
  rows_ = bottom_ - top_ + 1;
  columns_ = (right_ - left_) / kBits + 1;
  stride_ = rows_ + 2 * kGap_px;
  Extract(silhouette);
  outside_ = inside_;
  if (closes_gaps) CloseGaps();
  SetMargins(false, outside_);
  for (Word& word : outside_) word = ~word;
  WritePlanes();
}

void WindowMap::Extract(const Silhouette& silhouette) {
  inside_.assign(static_cast<std::size_t>(stride_) * (columns_ + 2), 0);
  for (int i = 0; i < columns_; ++i) {
    Word* const to = Column(inside_, i) - top_;
    for (int y = top_; y <= bottom_; ++y)
      to[y] = BitsAt(silhouette.row(y), silhouette.words_per_row(), left_ + i * kBits);
  }
}

void WindowMap::CloseGaps() {
  scratch_.resize(inside_.size());
  std::fill(scratch_.begin(), scratch_.end(), 0);
  const int count = WordsBetween();
  for (const int step : kGapSteps_px) {
    kernels::DilateSideways(Column(outside_, 0), count, stride_, step, Column(scratch_, 0));
    std::swap(outside_, scratch_);
  }
  for (const int step : kGapSteps_px) {
    kernels::DilateUpAndDown(Column(outside_, 0), count, step, Column(scratch_, 0));
    std::swap(outside_, scratch_);
  }
  // Pixels beyond the picture's edge count as set.
  SetMargins(true, outside_);
  SetMargins(true, scratch_);
  for (const int step : kGapSteps_px) {
    kernels::ErodeSideways(Column(outside_, 0), count, stride_, step, Column(scratch_, 0));
    std::swap(outside_, scratch_);
  }
  for (const int step : kGapSteps_px) {
    kernels::ErodeUpAndDown(Column(outside_, 0), count, step, Column(scratch_, 0));
    std::swap(outside_, scratch_);
  }
}

// Clears the margins of the region, or sets them where they are beyond the picture's edge.
void WindowMap::SetMargins(bool set_beyond_picture, Bits& bits) const {
  const auto filler = [&](bool is_edge) { return set_beyond_picture && is_edge ? ~Word{0} : 0; };
  const Word left = filler(left_ == 0), right = filler(right_ == width_px_ - 1);
  const Word above = filler(top_ == 0), below = filler(bottom_ == height_px_ - 1);
  const int last_bits = (right_ - left_) % kBits + 1;
  const Word beyond = last_bits == kBits ? 0 : ~Word{0} << last_bits;
  Word* const last = Column(bits, columns_ - 1);
  for (int row = 0; row < rows_; ++row) last[row] = (last[row] & ~beyond) | (right & beyond);
  std::fill_n(Column(bits, -1), rows_, left);
  std::fill_n(Column(bits, columns_), rows_, right);
  for (int i = -1; i <= columns_; ++i) {
    std::fill_n(Column(bits, i) - kGap_px, kGap_px, above);
    std::fill_n(Column(bits, i) + rows_, kGap_px, below);
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
    kernels::WidenWindows(Column(*bits, 0), WordsBetween(), stride_, step);
    kernels::HeightenWindows(Column(*bits, 0), columns_, stride_, rows_, step);
  }
  // Nothing below the region is inside.
  const int lowest = std::min(step, rows_);
  for (int i = 0; i < columns_; ++i) std::fill_n(Column(inside_, i) + rows_ - lowest, lowest, 0);
}

}  // namespace mocap
