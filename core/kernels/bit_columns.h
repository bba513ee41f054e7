// Sets of pixels as bits in columns of words. A word holds 32 pixels of a row, and the word below
// it those of the next row.
//
// Columns follow one another. `stride` words further on lies the column to the right.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mocap::kernels {

using ColumnWord = std::uint32_t;

/// Keeps pixels that are also set `step` to the right.
void WidenWindows(ColumnWord* bits, int count, std::ptrdiff_t stride, int step);
/// Keeps pixels that are also set `step` rows below. The last `step` of the rows stay.
void HeightenWindows(ColumnWord* bits, int columns, std::ptrdiff_t stride, int rows, int step);

/// Splits words of 32 pixels into two columns of 16: the lower half of a word is inside, the upper
/// half outside.
void JoinInsideAndOutside(const ColumnWord* inside, const ColumnWord* outside, int rows,
                          ColumnWord* left, ColumnWord* right);

}  // namespace mocap::kernels
