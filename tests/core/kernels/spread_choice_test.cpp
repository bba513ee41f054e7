#include "core/kernels/spread_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace mocap {
namespace {

TEST(SpreadChoice, TakesAsManyAsAreWanted) {
  std::vector<SpreadRank> ranks;
  SpreadChoice choice;
  for (int x = 0; x < 300; ++x) {
    ranks.push_back(RankOfPixel(x, 3 * x));
    choice.Add(ranks.back());
  }
  for (const std::size_t most : {0, 1, 37, 299, 300, 500}) {
    const std::uint64_t limit = choice.LimitFor(most);
    const auto taken =
        std::ranges::count_if(ranks, [&](const SpreadRank rank) { return rank < limit; });
    EXPECT_LE(taken, most);
    EXPECT_GE(taken + 1, std::min<std::size_t>(most, ranks.size()));
  }
}

// Of so many pixels chosen at random, the number in a block would differ by up to 13.
TEST(SpreadChoice, SpreadsPixelsEvenly) {
  constexpr int kSize = 256, kBlock = 16, kEach = 20;
  constexpr auto kLimit = static_cast<SpreadRank>((std::uint64_t{kEach} << 32) / (kBlock * kBlock));
  for (int top = 0; top < kSize; top += kBlock) {
    for (int left = 0; left < kSize; left += kBlock) {
      int chosen = 0;
      for (int y = top; y < top + kBlock; ++y)
        for (int x = left; x < left + kBlock; ++x) chosen += RankOfPixel(x, y) < kLimit;
      EXPECT_NEAR(chosen, kEach, 6) << left << ' ' << top;
    }
  }
}

TEST(SpreadChoice, SpreadsCellsEvenly) {
  constexpr int kSize = 64, kBlock = 8, kEach = 20;
  constexpr auto kLimit =
      static_cast<SpreadRank>((std::uint64_t{kEach} << 32) / (kBlock * kBlock * kBlock));
  for (int x0 = -kSize / 2; x0 < kSize / 2; x0 += kBlock) {
    for (int y0 = -kSize / 2; y0 < kSize / 2; y0 += kBlock) {
      int chosen = 0;
      for (int x = x0; x < x0 + kBlock; ++x)
        for (int y = y0; y < y0 + kBlock; ++y)
          for (int z = 0; z < kBlock; ++z) chosen += RankOfCell({x, y, z}) < kLimit;
      EXPECT_NEAR(chosen, kEach, 6) << x0 << ' ' << y0;
    }
  }
}

}  // namespace
}  // namespace mocap
