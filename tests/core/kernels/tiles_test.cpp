#include "core/kernels/tiles.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/kernels/tiles_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

constexpr int kTile = kTileSide;
constexpr int kTiles = 5;
constexpr int kStride = kTiles * kTile;
constexpr int kPixels = kStride * kTile + kTile;  // As many as can be read.
constexpr Allowance kAllowance{.gain = {1.1f, 0.9f, 1.0f}, .drift_sq = 2, .shift_sq = 0.3f};

// Over a tile, from its middle.
constexpr double kMiddle = (kTile - 1) / 2.0;
struct Plane {
  double At(int x, int y) const { return middle + right * (x - kMiddle) + down * (y - kMiddle); }
  double middle = 0, right = 0, down = 0;
};

// Tiles of any colours.
struct SomeTiles {
  SomeTiles() {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> level(0, 255);
    for (auto* planes : {&live, &expected})
      for (std::vector<std::uint8_t>& plane : *planes) {
        plane.resize(kPixels);
        for (std::uint8_t& value : plane) value = static_cast<std::uint8_t>(level(random));
      }
    for (int i = 0; i < kPixels; ++i) {
      variance.push_back(1 + static_cast<float>(level(random)) / 10);
      slope.push_back(static_cast<std::uint8_t>(level(random)));
    }
  }
  TilePixels From(int tile) const {
    TilePixels pixels{{}, {}, &variance[tile * kTile], &slope[tile * kTile], kStride};
    for (int c = 0; c < 3; ++c) {
      pixels.live[c] = &live[c][tile * kTile];
      pixels.expected[c] = &expected[c][tile * kTile];
    }
    return pixels;
  }
  // The plane closest to the pixels' brightness distortions.
  Plane BrightnessOf(int tile) const {
    constexpr double kArea = kTile * kTile, kSpread = kArea * (kArea - 1) / 12;
    Plane plane;
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const int i = y * kStride + tile * kTile + x;
        double along = 0, square = 1;
        for (int c = 0; c < 3; ++c) {
          along += kAllowance.gain[c] * live[c][i] * expected[c][i];
          square += expected[c][i] * expected[c][i];
        }
        plane.middle += along / square / kArea;
        plane.right += along / square * (x - kMiddle) / kSpread;
        plane.down += along / square * (y - kMiddle) / kSpread;
      }
    }
    return plane;
  }
  double ChiSquareOf(int tile, const Plane& brightness) const {
    double chi_square = 0;
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const int i = y * kStride + tile * kTile + x;
        double squares = 0;
        for (int c = 0; c < 3; ++c) {
          const double d = kAllowance.gain[c] * live[c][i] - brightness.At(x, y) * expected[c][i];
          squares += d * d;
        }
        chi_square += squares / (variance[i] + kAllowance.drift_sq +
                                 kAllowance.shift_sq * slope[i] * slope[i]);
      }
    }
    return chi_square / (kTile * kTile);
  }

  std::array<std::vector<std::uint8_t>, 3> live, expected;
  std::vector<float> variance;
  std::vector<std::uint8_t> slope;
};

TEST(TileKernels, ChiSquaresAreThoseOfThePlainDefinition) {
  const SomeTiles tiles;
  const std::array<float, kTiles> alphas = {1, 0.5f, 1.3f, 0.9f, 0.7f};
  for (int begin = 0; begin < kTiles; ++begin) {
    for (int count = 0; begin + count <= kTiles; ++count) {
      constexpr float kUntouched = -1;
      std::array<float, kTiles + 1> chi_squares;
      chi_squares.fill(kUntouched);
      MeasureChiSquares(tiles.From(begin), count, kAllowance, &alphas[begin], chi_squares.data());
      for (int i = 0; i < count; ++i) {
        const double wanted = tiles.ChiSquareOf(begin + i, {alphas[begin + i]});
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
    EXPECT_NEAR(ChiSquareBesideSlope(tiles.From(tile), kAllowance), wanted, 1e-4 * wanted) << tile;
  }
}

TEST(TileKernels, BitsAreThoseOfTheReference) {
  const SomeTiles tiles;
  const std::array<float, kTiles> alphas = {1, 0.5f, 1.3f, 0.9f, 0.7f};
  for (int count = 1; count <= kTiles; ++count) {
    const auto measured = [&](const auto& measure) {
      std::vector<float> chi_squares(static_cast<std::size_t>(count));
      measure(tiles.From(0), count, kAllowance, alphas.data(), chi_squares.data());
      return chi_squares;
    };
    ExpectSameBits([&] { return measured(reference::MeasureChiSquares); },
                   [&] { return measured(MeasureChiSquares); });
  }
  for (int tile = 0; tile < kTiles; ++tile) {
    ExpectSameBits(
        [&] { return std::vector{reference::ChiSquareBesideSlope(tiles.From(tile), kAllowance)}; },
        [&] { return std::vector{ChiSquareBesideSlope(tiles.From(tile), kAllowance)}; });
  }
}

TEST(TileKernels, MeansAreMeasuredOneByOne) {
  for (std::size_t count = 1; count < 40; ++count) {
    Numbers numbers;
    std::array<std::vector<float>, 8> from;
    for (std::vector<float>& means : from) means = numbers.Floats(count, 0, 255);
    from[0][0] = from[1][0] = from[2][0] = 0;  // Black is expected.
    const auto measured = [&](const auto& measure) {
      std::vector<float> results(3 * count);
      measure(&results[0], &results[count], &results[2 * count]);
      return results;
    };
    const auto at = [&](int i) { return from[i].data(); };
    const TileMeans all{{at(3), at(4), at(5)}, {at(0), at(1), at(2)}, at(6), at(7)};
    ExpectSameBits(
        [&] {
          return measured([&](float* alphas, float* tints, float* glares) {
            for (std::size_t i = 0; i < count; ++i)
              reference::MeasureTile(all, i, kAllowance, alphas[i], tints[i], glares[i]);
          });
        },
        [&] {
          return measured([&](float* alphas, float* tints, float* glares) {
            MeasureTiles(all, static_cast<int>(count), kAllowance, alphas, tints, glares);
          });
        });
  }
}

}  // namespace
}  // namespace mocap::kernels
