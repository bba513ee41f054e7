#include "core/kernels/statistics.h"

#include <algorithm>
#include <cstdlib>

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(StatisticsKernels, TheNumberAtARankIsThatOfTheSortedOnes) {
  for (std::size_t count = 1; count < 60; ++count) {
    std::vector<float> numbers = Numbers(static_cast<std::uint32_t>(count)).Floats(count, 0, 9);
    numbers[count / 2] = 0, numbers[count / 3] = numbers[0];
    std::vector<float> sorted = numbers;
    std::ranges::sort(sorted);
    ForEachTarget([&] {
      for (std::size_t rank = 0; rank < count; ++rank)
        EXPECT_EQ(NumberAtRank(numbers.data(), static_cast<int>(count), static_cast<int>(rank)),
                  sorted[rank]);
    });
  }
}

TEST(StatisticsKernels, NumbersAreComparedAndSortedIntoBinsOneByOne) {
  for (std::size_t count = 1; count < 60; ++count) {
    const std::vector<float> a = Numbers(1).Floats(count, -2, 9);
    const std::vector<float> b = Numbers(2).Floats(count, -2, 9);
    ExpectSameBits(
        [&] {
          std::vector<float> least = b;
          for (std::size_t i = 0; i < count; ++i) least[i] = std::min(least[i], a[i]);
          return least;
        },
        [&] {
          std::vector<float> least = b;
          TakeLesser(a.data(), count, least.data());
          return least;
        });
    ExpectSameBits(
        [&] {
          std::vector<int> bins;
          for (const float value : a)
            bins.push_back(std::clamp(static_cast<int>(value * 10), 0, 70));
          return bins;
        },
        [&] {
          std::vector<int> bins(count);
          FindBins(a.data(), static_cast<int>(count), 10, 71, bins.data());
          return bins;
        });
  }
}

TEST(StatisticsKernels, GradientsAreAddedPixelByPixel) {
  constexpr int kStride = 60, kGain = 250;
  const auto expected = Numbers(1).Integers<std::uint8_t>(5 * kStride);
  std::vector<std::uint8_t> live(expected.begin() + 2 * kStride, expected.begin() + 3 * kStride);
  for (std::size_t i = 0; i < live.size(); i += 2) live[i] = static_cast<std::uint8_t>(live[i] + i);
  const std::vector<float> variance = Numbers(2).Floats(kStride, 0, 10);
  for (int count = 1; count < kStride - 2; ++count) {
    ExpectSameBits(
        [&] {
          std::vector<std::int64_t> sums(5);
          for (int i = 1; i <= count; ++i) {
            const int x = 2 * kStride + i;
            const int gx = expected[x + 1] - expected[x - 1];
            const int gy = (8 * (expected[x + kStride] - expected[x - kStride]) -
                            (expected[x + 2 * kStride] - expected[x - 2 * kStride])) /
                           6;
            const int d = (kGain * live[i] + 128) / 256 - expected[x];
            if (std::abs(d) > 4 + std::abs(gx) + std::abs(gy) || variance[i] >= 8) continue;
            sums[0] += gx * gx, sums[1] += gx * gy, sums[2] += gy * gy;
            sums[3] += gx * d, sums[4] += gy * d;
          }
          return sums;
        },
        [&] {
          GradientSums sums;
          AddGradients(&live[1], &expected[2 * kStride + 1], &variance[1], kStride, kGain, 8, count,
                       sums);
          return std::vector<std::int64_t>{sums.xx, sums.xy, sums.yy, sums.xd, sums.yd};
        });
  }
}

}  // namespace
}  // namespace mocap::kernels
