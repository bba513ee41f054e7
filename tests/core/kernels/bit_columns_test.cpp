#include "core/kernels/bit_columns.h"

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

using Words = std::vector<ColumnWord>;

// Columns of rows with margins, as the kernels expect. Pixels are (column · 32 + bit, row).
constexpr int kBitColumns = 3, kBitRows = 21, kBitMargin = 3,
              kBitStride = kBitRows + 2 * kBitMargin;
constexpr int kBitCount = kBitColumns * kBitStride - 2 * kBitMargin;
constexpr std::size_t kFirst = kBitStride + kBitMargin;

Words SomeWords() {
  Words words = Numbers(6).Integers<ColumnWord>((kBitColumns + 2) * kBitStride);
  const Words more = Numbers(7).Integers<ColumnWord>(words.size());
  for (std::size_t i = 0; i < words.size(); ++i)
    if (i % 3 != 0) words[i] = i % 3 == 1 ? words[i] | more[i] : words[i] & more[i];
  return words;
}

bool At(const Words& words, std::size_t i, int bit) {
  // The word to the left or right holds pixels beyond this one.
  const auto word = static_cast<std::ptrdiff_t>(i) + (bit < 0    ? -kBitStride
                                                      : bit > 31 ? kBitStride
                                                                 : 0);
  return (words[static_cast<std::size_t>(word)] >> (bit & 31) & 1) != 0;
}

// Writes combine(word, bit) for all pixels of some words.
template <typename Combine>
Words Combined(const Combine& combine) {
  Words to((kBitColumns + 2) * kBitStride);
  for (std::size_t i = kFirst; i < kFirst + kBitCount; ++i)
    for (int bit = 0; bit < 32; ++bit) to[i] |= ColumnWord{combine(i, bit)} << bit;
  return to;
}
template <typename Kernel>
Words By(const Kernel& kernel) {
  Words to((kBitColumns + 2) * kBitStride);
  kernel(to.data() + kFirst);
  return to;
}

TEST(BitColumnKernels, WindowsGrowAsPixelByPixel) {
  const Words from = SomeWords();
  for (const int step : {1, 2, 4, 16}) {
    ExpectSameBits(
        [&] {
          Words to = from;
          for (std::size_t i = kFirst; i < kFirst + kBitCount; ++i)
            for (int bit = 0; bit < 32; ++bit)
              if (!At(from, i, bit + step)) to[i] &= ~(ColumnWord{1} << bit);
          return to;
        },
        [&] {
          Words to = from;
          WidenWindows(&to[kFirst], kBitCount, kBitStride, step);
          return to;
        });
    ExpectSameBits(
        [&] {
          Words to = from;
          for (int column = 0; column < kBitColumns; ++column) {
            for (int row = 0; row < kBitRows - step; ++row) {
              const auto i = kFirst + static_cast<std::size_t>(column * kBitStride + row);
              to[i] &= from[i + static_cast<std::size_t>(step)];
            }
          }
          return to;
        },
        [&] {
          Words to = from;
          HeightenWindows(&to[kFirst], kBitColumns, kBitStride, kBitRows, step);
          return to;
        });
  }
}

TEST(BitColumnKernels, WordsAreSplitIntoHalves) {
  for (std::size_t rows = 1; rows < 40; ++rows) {
    const Words inside = Numbers(1).Integers<ColumnWord>(rows);
    const Words outside = Numbers(2).Integers<ColumnWord>(rows);
    ExpectSameBits(
        [&] {
          Words halves(2 * rows);
          for (std::size_t i = 0; i < rows; ++i) {
            halves[i] = (inside[i] & 0xffff) | (outside[i] & 0xffff) << 16;
            halves[rows + i] = inside[i] >> 16 | outside[i] >> 16 << 16;
          }
          return halves;
        },
        [&] {
          Words halves(2 * rows);
          JoinInsideAndOutside(inside.data(), outside.data(), static_cast<int>(rows), halves.data(),
                               &halves[rows]);
          return halves;
        });
  }
}

}  // namespace
}  // namespace mocap::kernels
