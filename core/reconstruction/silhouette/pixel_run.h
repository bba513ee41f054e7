// §4: runs of adjacent pixels in a row.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace mocap {

/// Pixels [begin, end) of a row.
struct PixelRun {
  int begin = 0;
  int end = 0;
};

/// Finds the first pixel at or after `x` whose bit, inverted by `flip`, is set; `end` if there is
/// none.
inline int FindPixel(const std::uint64_t* row, int x, int end, std::uint64_t flip) {
  if (x >= end) return end;
  int i = x >> 6;
  std::uint64_t word = (row[i] ^ flip) & (~std::uint64_t{0} << (x & 63));
  const int last = (end - 1) >> 6;
  while (word == 0 && i < last) word = row[++i] ^ flip;
  return word == 0 ? end : std::min(end, i * 64 + std::countr_zero(word));
}

/// Calls `visit` for each run of pixels in [begin, end) whose bits, inverted by `flip`, are set.
template <typename Visit>
void ForEachRun(const std::uint64_t* row, int begin, int end, std::uint64_t flip, Visit visit) {
  for (int x = begin;;) {
    const int first = FindPixel(row, x, end, flip);
    if (first == end) return;
    x = FindPixel(row, first, end, ~flip);
    visit(PixelRun{first, x});
  }
}

}  // namespace mocap
