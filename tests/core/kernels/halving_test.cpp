#include "core/kernels/halving.h"

#include "core/kernels/halving_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(HalvingKernels, TilesAreHalvedAsPixelByPixel) {
  for (int tiles = 2; tiles < 8; ++tiles) {
    const int width = tiles * kTileSide, stride = 6 * width + 5;
    // Nothing is read before the first byte or after the last.
    const std::vector<std::uint8_t> pixels = Numbers().Integers<std::uint8_t>(
        static_cast<std::size_t>(stride * (kRowStep_px * (kTileRows - 1) + 1) + 6 * width));
    const auto halved = [&](const auto& halve) {
      std::array<std::vector<std::uint8_t>, 3> color;
      std::vector<float> means(static_cast<std::size_t>(3 * tiles));
      HalvedTiles to{{}, {}, width};
      for (int c = 0; c < 3; ++c) {
        color[c].resize(static_cast<std::size_t>(width * kTileRows));
        to.color[c] = color[c].data();
        to.tile_mean[c] = &means[static_cast<std::size_t>(c * tiles)];
      }
      halve(pixels.data(), stride, tiles, to);
      for (const auto& plane : color) means.insert(means.end(), plane.begin(), plane.end());
      return means;
    };
    ExpectSameBits([&] { return halved(reference::HalveTiles); },
                   [&] { return halved(HalveTiles); });
  }
}

TEST(HalvingKernels, EveryRoundingOfAMeanOfFourIsRight) {
  // Two tiles whose four pixels at each place have the levels base + 0 to 3, in all combinations.
  constexpr int kWidth = 2 * kTileSide, kStride = 6 * kWidth;
  for (int base = 0; base <= 252; base += 28) {
    for (int combination = 0; combination < 256; combination += kWidth) {
      std::vector<std::uint8_t> pixels(kStride * kRowStep_px * kTileRows, 0);
      for (int x = 0; x < kWidth; ++x) {
        const int levels = combination + x;
        const auto at = [&](int u, int v) -> std::uint8_t& {
          return pixels[static_cast<std::size_t>(v * kStride + 3 * (2 * x + u))];
        };
        at(0, 0) = static_cast<std::uint8_t>(base + (levels & 3));
        at(1, 0) = static_cast<std::uint8_t>(base + (levels >> 2 & 3));
        at(0, 1) = static_cast<std::uint8_t>(base + (levels >> 4 & 3));
        at(1, 1) = static_cast<std::uint8_t>(base + (levels >> 6 & 3));
      }
      ForEachTarget([&] {
        std::vector<std::uint8_t> blue(kWidth * kTileRows), rest = blue;
        std::vector<float> means(2);
        HalveTiles(pixels.data(), kStride, 2,
                   {{blue.data(), rest.data(), rest.data()},
                    {means.data(), means.data(), means.data()},
                    kWidth});
        for (int x = 0; x < kWidth; ++x) {
          const int levels = combination + x;
          const int sum = (levels & 3) + (levels >> 2 & 3) + (levels >> 4 & 3) + (levels >> 6 & 3);
          EXPECT_EQ(blue[x], base + (sum + 2) / 4);
        }
      });
    }
  }
}

TEST(HalvingKernels, RowsOfTilesAreAveragedAsPixelByPixel) {
  for (int tiles = 1; tiles < 20; ++tiles) {
    const int width = tiles * kTileSide;
    const auto pixels =
        Numbers().Integers<std::uint8_t>(static_cast<std::size_t>(width * kTileRows));
    std::vector<std::uint16_t> columns(static_cast<std::size_t>(width));
    const auto averaged = [&](const auto& average) {
      std::vector<float> means(static_cast<std::size_t>(tiles));
      average(means.data());
      return means;
    };
    ExpectSameBits(
        [&] {
          return averaged(
              [&](float* means) { reference::AverageTiles(pixels.data(), width, means); });
        },
        [&] {
          return averaged(
              [&](float* means) { AverageTiles(pixels.data(), width, columns.data(), means); });
        });
  }
}

}  // namespace
}  // namespace mocap::kernels
