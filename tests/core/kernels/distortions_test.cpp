#include "core/kernels/distortions.h"

#include "core/kernels/distortions_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

constexpr int kBlockPixels = WeighedPixels::kPixels;
constexpr std::array<float, 3> kLightGain = {1.1f, 0.9f, 1.03f};

// A band, and its expected pixels.
struct Band {
  Band(int groups_per_row, int rows) : width(groups_per_row * kBlockPixels), height(rows) {
    Numbers numbers(7);
    groups.resize(static_cast<std::size_t>(groups_per_row * (height + 2)));
    for (WeighedPixels& group : groups) {
      for (int k = 0; k < kBlockPixels; ++k) {
        for (int c = 0; c < 3; ++c) {
          group.mean[c][k] = static_cast<std::uint16_t>(256 + numbers.Below(65280));
          group.inverse_sigma[c][k] = static_cast<std::uint16_t>(1 + numbers.Below(65535));
        }
        group.alpha_weight[k] = static_cast<std::uint16_t>(numbers.Below(65536));
      }
    }
    for (int i = 0; i < width * height + 1; ++i) {
      const auto level = [&] { return static_cast<std::uint8_t>(numbers.Below(256)); };
      pixels.push_back({level(), level(), level()});
    }
  }
  template <typename Measure>
  std::vector<float> Measured(const Measure& measure) const {
    const int step = width + 5, plane = step * height;
    std::vector<float> results(static_cast<std::size_t>(7 * plane), -1.0f);
    const auto from = [&](int i) { return &results[static_cast<std::size_t>(i * plane + 3)]; };
    // The second pixel is not aligned.
    measure(groups.data(), height + 2, ImageView<const Bgr>(&pixels[1], width, height),
            DistortionRows{from(0), {from(1), from(2), from(3)}, from(4), from(5), from(6), step});
    return results;
  }
  int width, height;
  std::vector<WeighedPixels> groups;
  std::vector<Bgr> pixels;
};

TEST(DistortionKernels, BandsAreMeasuredAsPixelByPixel) {
  for (const int groups : {1, 2, 5}) {
    for (const int rows : {1, 4}) {
      const Band band(groups, rows);
      ExpectSameBits(
          [&] {
            return band.Measured([](auto* from, int step, auto pixels, const auto& to) {
              reference::MeasureDistortions(from, step, pixels, kLightGain, to);
            });
          },
          [&] {
            return band.Measured([](auto* from, int step, auto pixels, const auto& to) {
              MeasureDistortions(from, step, pixels, kLightGain, 0, to);
            });
          });
    }
  }
}

}  // namespace
}  // namespace mocap::kernels
