#include "core/kernels/tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/kernels/tiles_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

constexpr int kTiles = 5;
constexpr int kTileStride = kTiles * kTileSide;
constexpr Allowance kAllowance{.gain = {1.1f, 0.9f, 1.0f}, .drift_sq = 2, .shift_sq = 0.3f};

// Over a tile, from its middle.
struct Plane {
  double At(int x, int y) const {
    return middle + right * (x - (kTileSide - 1) / 2.0) + down * (y - (kTileRows - 1) / 2.0);
  }
  double middle = 0, right = 0, down = 0;
};

// Tiles of any colours.
struct SomeTiles {
  SomeTiles() {
    Numbers numbers(7);
    for (auto* planes : {&live, &expected})
      for (auto& plane : *planes) plane = numbers.Integers<std::uint8_t>(kTileStride * kTileRows);
    weights = numbers.Floats(kTiles, 0.01f, 1);
    alphas = numbers.Floats(kTiles, 0.5f, 1.3f);
  }
  TilePixels From(int tile) const {
    TilePixels pixels{{}, {}, kTileStride};
    for (int c = 0; c < 3; ++c) {
      pixels.live[c] = &live[c][tile * kTileSide];
      pixels.expected[c] = &expected[c][tile * kTileSide];
    }
    return pixels;
  }
  // Calls visit(x, y, c, live, expected) for the pixels of a tile.
  template <typename Visit>
  void ForEach(int tile, Visit visit) const {
    for (int y = 0; y < kTileRows; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        for (int c = 0; c < 3; ++c) {
          const int i = y * kTileStride + tile * kTileSide + x;
          visit(x, y, c, double{kAllowance.gain[c]} * live[c][i], double(expected[c][i]));
        }
      }
    }
  }
  // The plane closest to the pixels' brightness distortions.
  Plane BrightnessOf(int tile) const {
    std::array<std::array<double, kTileSide>, kTileRows> along{}, square{};
    ForEach(tile, [&](int x, int y, int, double value, double wanted) {
      along[y][x] += value * wanted, square[y][x] += wanted * wanted;
    });
    Plane plane;
    double right_sq = 0, down_sq = 0;
    for (int y = 0; y < kTileRows; ++y) {
      for (int x = 0; x < kTileSide; ++x) {
        const double alpha = along[y][x] / (square[y][x] + 1);
        const double right = x - (kTileSide - 1) / 2.0, down = y - (kTileRows - 1) / 2.0;
        plane.middle += alpha / kTilePixels, plane.right += alpha * right;
        plane.down += alpha * down, right_sq += right * right, down_sq += down * down;
      }
    }
    plane.right /= right_sq;
    plane.down = std::clamp<double>(plane.down / down_sq, -kSteepestShadow, kSteepestShadow);
    return plane;
  }
  double ChiSquareOf(int tile, const Plane& brightness) const {
    double squares = 0;
    ForEach(tile, [&](int x, int y, int, double value, double wanted) {
      squares += std::pow(value - brightness.At(x, y) * wanted, 2);
    });
    return squares / kTilePixels * weights[tile];
  }

  std::array<std::vector<std::uint8_t>, 3> live, expected;
  std::vector<float> weights, alphas;
};

TEST(TileKernels, ChiSquaresAreThoseOfThePlainDefinition) {
  const SomeTiles tiles;
  for (int begin = 0; begin < kTiles; ++begin) {
    for (int count = 0; begin + count <= kTiles; ++count) {
      constexpr float kUntouched = -1;
      std::array<float, kTiles + 1> chi_squares;
      chi_squares.fill(kUntouched);
      std::array<float, 2 * kTileStride> scratch;
      MeasureChiSquares(tiles.From(begin), count, kAllowance.gain, &tiles.alphas[begin],
                        &tiles.weights[begin], scratch.data(), chi_squares.data());
      for (int i = 0; i < count; ++i) {
        const double wanted = tiles.ChiSquareOf(begin + i, {tiles.alphas[begin + i]});
        EXPECT_NEAR(chi_squares[i], wanted, 1e-4 * wanted) << begin << " " << i;
      }
      EXPECT_EQ(chi_squares[count], kUntouched);
    }
  }
}

TEST(TileKernels, ChiSquareBesideSlopeIsThatOfThePlainDefinition) {
  const SomeTiles tiles;
  for (int tile = 0; tile < kTiles; ++tile) {
    const Plane plane = tiles.BrightnessOf(tile);
    const double wanted = tiles.ChiSquareOf(tile, plane);
    EXPECT_GT(std::abs(tiles.ChiSquareOf(tile, {plane.middle}) - wanted), 1e-3 * wanted);
    EXPECT_NEAR(ChiSquareBesideSlope(tiles.From(tile), kAllowance.gain, tiles.weights[tile]),
                wanted, 1e-4 * wanted)
        << tile;
  }
}

TEST(TileKernels, BitsAreThoseOfTheReference) {
  const SomeTiles tiles;
  for (int count = 1; count <= kTiles; ++count) {
    const auto size = static_cast<std::size_t>(count);
    ExpectSameBits(
        [&] {
          std::vector<float> chi_squares(size);
          for (int i = 0; i < count; ++i)
            chi_squares[i] = reference::ChiSquareOf(tiles.From(i), kAllowance.gain, tiles.alphas[i],
                                                    tiles.weights[i]);
          return chi_squares;
        },
        [&] {
          std::vector<float> chi_squares(size);
          std::array<float, 2 * kTileStride> scratch;
          MeasureChiSquares(tiles.From(0), count, kAllowance.gain, tiles.alphas.data(),
                            tiles.weights.data(), scratch.data(), chi_squares.data());
          return chi_squares;
        });
  }
}

TEST(TileKernels, MeansAreMeasuredOneByOne) {
  for (std::size_t count = 1; count < 40; ++count) {
    Numbers numbers;
    std::array<std::vector<float>, 8> from;
    for (std::vector<float>& means : from) means = numbers.Floats(count, 0, 255);
    from[0][0] = from[1][0] = from[2][0] = 0;  // Black is expected.
    const auto measured = [&](const auto& measure) {
      std::vector<float> results(4 * count);
      measure({&results[0], &results[count], &results[2 * count], &results[3 * count]});
      return results;
    };
    const auto at = [&](int i) { return from[i].data(); };
    const TileMeans all{{at(3), at(4), at(5)}, {at(0), at(1), at(2)}, at(6), at(7)};
    ExpectSameBits(
        [&] {
          return measured([&](const TileDeviations& to) {
            for (std::size_t i = 0; i < count; ++i) reference::MeasureTile(all, i, kAllowance, to);
          });
        },
        [&] {
          return measured([&](const TileDeviations& to) {
            MeasureTiles(all, static_cast<int>(count), kAllowance, to);
          });
        });
  }
}

}  // namespace
}  // namespace mocap::kernels
