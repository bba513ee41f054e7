#include "core/kernels/mixing.h"

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

TEST(MixingKernels, RowsAreMixedOneByOne) {
  for (std::size_t count = 1; count < 40; ++count) {
    const std::vector<float> top = Numbers(1).Floats(count + 1, 0, 255);
    const std::vector<float> bottom = Numbers(2).Floats(count + 1, 0, 255);
    const auto bytes = Numbers(3).Integers<std::uint8_t>(2 * (count + 1));
    const std::uint8_t* const lower = &bytes[count + 1];
    const std::array<int, 4> weights = {100, 60, 50, 46};
    const float a = 0.3f, b = 0.8f;
    const auto floats = [&](const auto& fill) {
      std::vector<float> to(count);
      fill(to);
      return to;
    };
    ExpectSameBits(
        [&] {
          return floats([&](std::vector<float>& to) {
            for (std::size_t x = 0; x < count; ++x)
              to[x] = (1 - a) * (1 - b) * top[x] + a * (1 - b) * top[x + 1] +
                      (1 - a) * b * bottom[x] + a * b * bottom[x + 1];
          });
        },
        [&] {
          return floats([&](std::vector<float>& to) {
            MixNeighbours(top.data(), bottom.data(), static_cast<int>(count), a, b, to.data());
          });
        });
    ExpectSameBits(
        [&] {
          return floats([&](std::vector<float>& to) {
            for (std::size_t x = 0; x < count; ++x) to[x] = top[x] + b * (bottom[x] - top[x]);
          });
        },
        [&] {
          return floats([&](std::vector<float>& to) {
            MixRows(top.data(), bottom.data(), static_cast<int>(count), b, to.data());
          });
        });
    ExpectSameBits(
        [&] {
          std::vector<std::uint8_t> to(count);
          for (std::size_t x = 0; x < count; ++x)
            to[x] = static_cast<std::uint8_t>((weights[0] * bytes[x] + weights[1] * bytes[x + 1] +
                                               weights[2] * lower[x] + weights[3] * lower[x + 1] +
                                               128) /
                                              256);
          return to;
        },
        [&] {
          std::vector<std::uint8_t> to(count);
          MixByteNeighbours(bytes.data(), lower, static_cast<int>(count), weights, to.data());
          return to;
        });
    for (const int width : {4, 8}) {
      const auto spread = [&](const auto& fill) {
        std::vector<float> to(count * static_cast<std::size_t>(width));
        fill(to.data());
        return to;
      };
      ExpectSameBits(
          [&] {
            return spread([&](float* to) {
              for (std::size_t i = 0; i < count; ++i)
                for (int k = 0; k < width; ++k)
                  *to++ = top[i] + (0.05f + static_cast<float>(k) / static_cast<float>(width)) *
                                       (top[i + 1] - top[i]);
            });
          },
          [&] {
            return spread([&](float* to) {
              SpreadCells(top.data(), static_cast<int>(count), width, 0.05f, to);
            });
          });
    }
  }
}

TEST(MixingKernels, PicturesAreReadPixelByPixel) {
  constexpr std::size_t kCount = 37;
  constexpr int kStride = 50;
  const auto pixels = Numbers(1).Integers<PackedPixel>(kStride * 40);
  const std::vector<float> x = Numbers(2).Floats(kCount, 0, kStride - 1.01f);
  const std::vector<float> y = Numbers(3).Floats(kCount, 0, 38.9f);
  const auto byte_at = [&](int column, int row, int channel) {
    return static_cast<std::uint8_t>(pixels[static_cast<std::size_t>(row * kStride + column)] >>
                                     8 * channel);
  };
  const auto read = [&](const auto& fill) {
    std::vector<float> numbers(3 * kCount);
    std::vector<std::uint8_t> slope(kCount);
    fill(std::array<float*, 3>{&numbers[0], &numbers[kCount], &numbers[2 * kCount]}, slope.data());
    numbers.insert(numbers.end(), slope.begin(), slope.end());
    return numbers;
  };
  ExpectSameBits(
      [&] {
        return read([&](const std::array<float*, 3>& color, std::uint8_t* slope) {
          for (std::size_t i = 0; i < kCount; ++i) {
            const int column = static_cast<int>(x[i]), row = static_cast<int>(y[i]);
            const float u = x[i] - static_cast<float>(column), v = y[i] - static_cast<float>(row);
            for (int c = 0; c < 3; ++c)
              color[c][i] = (1 - u) * (1 - v) * byte_at(column, row, c) +
                            u * (1 - v) * byte_at(column + 1, row, c) +
                            (1 - u) * v * byte_at(column, row + 1, c) +
                            u * v * byte_at(column + 1, row + 1, c);
            slope[i] = byte_at(column + (u > 0.5f), row + (v > 0.5f), 3);
          }
        });
      },
      [&] {
        return read([&](const std::array<float*, 3>& color, std::uint8_t* slope) {
          ReadBetween(pixels.data(), kStride, x.data(), y.data(), kCount, color, slope);
        });
      });
  const auto read_bytes = [&](const auto& fill) {
    std::vector<std::uint8_t> bytes(4 * kCount);
    fill(std::array<std::uint8_t*, 3>{&bytes[0], &bytes[kCount], &bytes[2 * kCount]},
         &bytes[3 * kCount]);
    return bytes;
  };
  ExpectSameBits(
      [&] {
        return read_bytes([&](const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope) {
          for (std::size_t i = 0; i < kCount; ++i) {
            const int column = static_cast<int>(x[i] * 0.5f + 0.25f);
            const int row = static_cast<int>(y[i] * 0.5f + 0.25f);
            for (int c = 0; c < 3; ++c) color[c][i] = byte_at(column, row, c);
            slope[i] = byte_at(column, row, 3);
          }
        });
      },
      [&] {
        return read_bytes([&](const std::array<std::uint8_t*, 3>& color, std::uint8_t* slope) {
          ReadNearestHalf(pixels.data(), kStride, x.data(), y.data(), kCount, color, slope);
        });
      });
}

}  // namespace
}  // namespace mocap::kernels
