#include "core/reconstruction/carving/window_map.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/vectorized.h"

namespace mocap {
namespace {

using Word = std::uint32_t;
constexpr int kBits = 32;
// One after the other they dilate, or erode, by the width of a gap.
constexpr std::array<int, 3> kGapSteps_px = {1, 2, 3};
static_assert(kGapSteps_px[0] + kGapSteps_px[1] + kGapSteps_px[2] == WindowMap::kGap_px);

// Rows follow one another with a word of margin between them, so that one loop shifts all of them.
// What is shifted out of two rows into the margin between them does not meet there.

MOCAP_VECTORIZED
void DilateAlong(const Word* from, int count, int step, Word* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    to[i] = from[i] | from[i] << step | from[i - 1] >> (kBits - step) | from[i] >> step |
            from[i + 1] << (kBits - step);
}

MOCAP_VECTORIZED
void ErodeAlong(const Word* from, int count, int step, Word* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i)
    to[i] = from[i] & (from[i] << step | from[i - 1] >> (kBits - step)) &
            (from[i] >> step | from[i + 1] << (kBits - step));
}

// `reach` words lie between rows that are `step` apart.
MOCAP_VECTORIZED
void DilateAcross(const Word* from, int count, std::ptrdiff_t reach, Word* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) to[i] = from[i] | from[i - reach] | from[i + reach];
}

MOCAP_VECTORIZED
void ErodeAcross(const Word* from, int count, std::ptrdiff_t reach, Word* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) to[i] = from[i] & from[i - reach] & from[i + reach];
}

// Lets windows grow to the right, and down.
MOCAP_VECTORIZED
void Widen(Word* bits, int count, int step) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) bits[i] &= bits[i] >> step | bits[i + 1] << (kBits - step);
}

MOCAP_VECTORIZED
void Heighten(Word* bits, int count, std::ptrdiff_t reach) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) bits[i] &= bits[i + reach];
}

MOCAP_VECTORIZED
void Interleave(const Word* inside, const Word* outside, int count, Word* to) {
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    to[2 * i] = (inside[i] & 0xffff) | outside[i] << 16;
    to[2 * i + 1] = inside[i] >> 16 | (outside[i] & 0xffff0000);
  }
}

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
  stride_ = (right_ - left_) / kBits + 2;
  Extract(silhouette);
  outside_ = inside_;
  if (closes_gaps) CloseGaps();
  SetMargins(false, outside_);
  for (Word& word : outside_) word = ~word;
  WritePlanes();
}

void WindowMap::Extract(const Silhouette& silhouette) {
  inside_.assign(static_cast<std::size_t>(stride_) * (rows_ + 2 * kGap_px) + 2, 0);
  Word* to = FirstRow(inside_);
  for (int y = top_; y <= bottom_; ++y, to += stride_)
    for (int i = 0; i + 1 < stride_; ++i)
      to[i] = BitsAt(silhouette.row(y), silhouette.words_per_row(), left_ + i * kBits);
}

void WindowMap::CloseGaps() {
  scratch_.resize(inside_.size());
  std::fill(scratch_.begin(), scratch_.end(), 0);
  const int count = stride_ * rows_;
  for (const int step : kGapSteps_px) {
    DilateAlong(FirstRow(outside_), count, step, FirstRow(scratch_));
    std::swap(outside_, scratch_);
  }
  for (const int step : kGapSteps_px) {
    DilateAcross(FirstRow(outside_), count, step * stride_, FirstRow(scratch_));
    std::swap(outside_, scratch_);
  }
  // What lies beyond the picture's edge counts as set.
  SetMargins(true, outside_);
  SetMargins(true, scratch_);
  for (const int step : kGapSteps_px) {
    ErodeAlong(FirstRow(outside_), count, step, FirstRow(scratch_));
    std::swap(outside_, scratch_);
  }
  for (const int step : kGapSteps_px) {
    ErodeAcross(FirstRow(outside_), count, step * stride_, FirstRow(scratch_));
    std::swap(outside_, scratch_);
  }
}

// Empties what is beside the region; or sets it where that is beyond the picture's edge.
void WindowMap::SetMargins(bool set_beyond_picture, Bits& bits) const {
  const Word all = ~Word{0};
  const bool set_left = set_beyond_picture && left_ == 0;
  const bool set_right = set_beyond_picture && right_ == width_px_ - 1;
  const Word above = set_beyond_picture && top_ == 0 ? all : 0;
  const Word below = set_beyond_picture && bottom_ == height_px_ - 1 ? all : 0;
  // A margin's lower half is right of a row, its upper half left of the next.
  const Word between = (set_right ? all >> kBits / 2 : 0) | (set_left ? all << kBits / 2 : 0);
  Word* const first = FirstRow(bits);
  std::fill(bits.data(), first, above);
  first[-1] = (first[-1] & all >> kBits / 2) | (set_left ? all << kBits / 2 : 0);
  const int last_bits = (right_ - left_) % kBits + 1;
  const Word beyond = last_bits == kBits ? 0 : all << last_bits;
  for (int row = 0; row < rows_; ++row) {
    Word* const last = first + row * stride_ + stride_ - 2;
    last[0] = (last[0] & ~beyond) | (set_right ? beyond : 0);
    last[1] = between;
  }
  std::fill(first + stride_ * rows_, bits.data() + bits.size(), below);
}

void WindowMap::WritePlanes() {
  const int count = stride_ * rows_;
  const std::size_t words = static_cast<std::size_t>(2) * count;
  planes_.resize(words * kPlanes);
  Word* const inside = FirstRow(inside_);
  Word* const outside = FirstRow(outside_);
  Interleave(inside, outside, count, planes_.data());
  for (int plane = 1; plane < kPlanes; ++plane) {
    const int step = 1 << (plane - 1);
    const int higher = stride_ * std::max(rows_ - step, 0);
    for (Word* const bits : {inside, outside}) {
      Widen(bits, count, step);
      Heighten(bits, higher, step * stride_);
    }
    // Below the region nothing is inside.
    std::fill(inside + higher, inside + count, 0);
    Interleave(inside, outside, count, &planes_[words * plane]);
  }
}

}  // namespace mocap
