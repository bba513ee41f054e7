#include "core/kernels/bits.h"

#include <bit>

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

using BitWords = std::vector<BitWord>;

bool At(const BitWords& words, std::size_t begin, std::size_t per_row, int x, bool beyond) {
  if (x < 0 || x >= static_cast<int>(per_row) * 64) return beyond;
  return (words[begin + static_cast<std::size_t>(x) / 64] >> (x % 64) & 1) != 0;
}

// Combines each pixel with its neighbours to the left and right, one by one.
BitWords CombinedAlong(const BitWords& from, std::size_t per_row, int radius, bool all) {
  BitWords to(from.size());
  for (std::size_t begin = 0; begin < from.size(); begin += per_row) {
    for (int x = 0; x < static_cast<int>(per_row) * 64; ++x) {
      bool result = all;
      for (int i = -radius; i <= radius; ++i) {
        const bool bit = At(from, begin, per_row, x + i, all);
        result = all ? result && bit : result || bit;
      }
      to[begin + static_cast<std::size_t>(x) / 64] |= BitWord{result} << (x % 64);
    }
  }
  return to;
}

TEST(BitKernels, RowsOfAnyLengthAreCombinedAlongAsPixelByPixel) {
  Numbers numbers;
  for (const std::size_t per_row :
       {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{10}, kMostRowWords}) {
    for (const std::size_t rows : {std::size_t{1}, std::size_t{7}, std::size_t{40}}) {
      for (int radius = 1; radius <= 3; ++radius) {
        BitWords words = numbers.Integers<BitWord>(per_row * rows);
        // Long runs too.
        for (std::size_t i = 0; i < words.size(); i += 3) words[i] = ~BitWord{0};
        ExpectSameBits([&] { return CombinedAlong(words, per_row, radius, true); },
                       [&] {
                         BitWords to = words;
                         KeepCommonAlong(to.data(), to.size(), per_row, radius);
                         return to;
                       });
        for (BitWord& word : words) word &= word << 7 & word >> 9;
        ExpectSameBits([&] { return CombinedAlong(words, per_row, radius, false); },
                       [&] {
                         BitWords to = words;
                         AddAllAlong(to.data(), to.size(), per_row, radius);
                         return to;
                       });
      }
    }
  }
}

TEST(BitKernels, WordsAreCombinedAndCountedOneByOne) {
  Numbers numbers(2);
  for (std::size_t count = 0; count < 40; ++count) {
    const BitWords from = numbers.Integers<BitWord>(count + 1),
                   before = numbers.Integers<BitWord>(41);
    const auto combined = [&](const auto& combine) {
      BitWords to = before;
      for (std::size_t i = 0; i < count; ++i) to[i] = combine(to[i], from[i]);
      return to;
    };
    const auto by = [&](const auto& kernel) {
      BitWords to = before;
      kernel(from.data(), count, to.data());
      return to;
    };
    ExpectSameBits([&] { return combined([](BitWord a, BitWord b) { return a & b; }); },
                   [&] { return by(KeepCommon); });
    ExpectSameBits([&] { return combined([](BitWord a, BitWord b) { return a | b; }); },
                   [&] { return by(AddAll); });
    ExpectSameBits([&] { return combined([](BitWord a, BitWord b) { return a & ~b; }); },
                   [&] { return by(RemoveAll); });
    std::int64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) bits += std::popcount(from[i]);
    ForEachTarget([&] { EXPECT_EQ(CountBits(from.data(), count), bits); });
  }
}

}  // namespace
}  // namespace mocap::kernels
