#include "core/kernels/bits.h"

#include <bit>

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

using Words = std::vector<BitWord>;

bool At(const Words& words, std::size_t begin, std::size_t per_row, int x, bool beyond) {
  if (x < 0 || x >= static_cast<int>(per_row) * 64) return beyond;
  return (words[begin + static_cast<std::size_t>(x) / 64] >> (x % 64) & 1) != 0;
}

// Combines each pixel with its neighbours to the left and right, one by one.
Words CombinedAlong(const Words& from, std::size_t per_row, int radius, bool all) {
  Words to(from.size());
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
        Words words = numbers.Integers<BitWord>(per_row * rows);
        // Long runs too.
        for (std::size_t i = 0; i < words.size(); i += 3) words[i] = ~BitWord{0};
        ExpectSameBits([&] { return CombinedAlong(words, per_row, radius, true); },
                       [&] {
                         Words to = words;
                         KeepCommonAlong(to.data(), to.size(), per_row, radius);
                         return to;
                       });
        for (BitWord& word : words) word &= word << 7 & word >> 9;
        ExpectSameBits([&] { return CombinedAlong(words, per_row, radius, false); },
                       [&] {
                         Words to = words;
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
    const Words from = numbers.Integers<BitWord>(count + 1), before = numbers.Integers<BitWord>(41);
    const auto combined = [&](const auto& combine) {
      Words to = before;
      for (std::size_t i = 0; i < count; ++i) to[i] = combine(to[i], from[i]);
      return to;
    };
    const auto by = [&](const auto& kernel) {
      Words to = before;
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

TEST(BitKernels, PixelsBesideTheOtherPlaneAreRemoved) {
  constexpr std::ptrdiff_t kStride = 4, kHeight = 9;
  Numbers numbers(3);
  // Sparse planes, with an empty word before each row and empty rows above and below.
  Words person((kHeight + 2) * kStride + 1), background = person;
  for (std::ptrdiff_t y = 1; y <= kHeight; ++y) {
    for (std::ptrdiff_t i = 1; i < kStride; ++i) {
      const Words random = numbers.Integers<BitWord>(6);
      person[y * kStride + i] = random[0] & random[1] & random[2];
      background[y * kStride + i] = random[3] & random[4] & random[5];
    }
  }
  const auto bit = [&](const Words& plane, std::ptrdiff_t y, std::ptrdiff_t x) {
    return x >= 0 && (plane[y * kStride + 1 + x / 64] >> (x % 64) & 1) != 0;
  };
  const auto apart = [&](const Words& plane, const Words& other, Words& to) {
    for (std::ptrdiff_t y = 1; y <= kHeight; ++y) {
      for (std::ptrdiff_t x = 0; x < (kStride - 1) * 64; ++x) {
        bool touches = false;
        for (std::ptrdiff_t v = y - 1; v <= y + 1; ++v)
          for (std::ptrdiff_t u = x - 1; u <= x + 1; ++u) touches = touches || bit(other, v, u);
        if (bit(plane, y, x) && !touches) to[(y - 1) * kStride + x / 64] |= BitWord{1} << (x % 64);
      }
    }
  };
  const auto joined = [](Words a, const Words& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  ExpectSameBits(
      [&] {
        Words inside(kHeight * kStride), outside = inside;
        apart(person, background, inside), apart(background, person, outside);
        return joined(inside, outside);
      },
      [&] {
        Words inside(kHeight * kStride), outside = inside;
        KeepApart(&person[kStride + 1], &background[kStride + 1], kStride, kHeight * kStride - 1,
                  inside.data(), outside.data());
        return joined(inside, outside);
      });
}

}  // namespace
}  // namespace mocap::kernels
