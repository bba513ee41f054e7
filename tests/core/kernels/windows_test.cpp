#include "core/kernels/windows.h"

#include <cmath>

#include "core/kernels/windows_reference.h"
#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

constexpr int kPad = 3;

// Measured pixels of as many lines as windows around two rows need, and the sums along them.
class WindowKernels : public ::testing::Test {
 protected:
  static constexpr int kBlocks = 5, kWidth = kBlocks * kBlock_px, kStep = kWidth + 2 * kPad;
  static constexpr int kLines = kPairLines;
  static constexpr std::size_t kNumbers = kStep * kLines;

  WindowKernels() {
    Numbers numbers(3);
    alpha_shift_ = numbers.Floats(kNumbers, -0.6f, 0.4f);
    for (auto& cd : cd_) cd = numbers.Floats(kNumbers, -9, 9);
    cd_sq_ = numbers.Floats(kNumbers, 0, 90);
    alpha_weight_ = numbers.Floats(kNumbers, 5, 60);
    inverse_sigma_ = numbers.Floats(kNumbers, 0.05f, 0.6f);
    sums_ = Summed(reference::SumAlongLines);
    for (int row = 0; row < 2; ++row) {
      const int i = (row + kLargestRadius_px) * kStep + kPad;
      pair_.rows[row] = {&alpha_shift_[i], &cd_sq_[i], &alpha_weight_[i], &inverse_sigma_[i]};
    }
    for (int line = 0; line < kPairLines; ++line) pair_.sums[line] = &sums_[line];
  }

  template <typename Sum>
  std::vector<BlockSums> Summed(const Sum& sum) const {
    std::vector<BlockSums> sums(kBlocks * kSumLines);
    sum(&alpha_shift_[kPad], {&cd_[0][kPad], &cd_[1][kPad], &cd_[2][kPad]}, kStep, kBlocks, kLines,
        sums.data());
    return sums;
  }

  template <typename Judge>
  std::vector<std::uint8_t> Judged(const Judge& judge, int begin, int end, int rows) const {
    std::vector<std::uint8_t> bytes(12 * kBlocks);
    std::array<DecisionBytes, 2> to;
    std::uint8_t* next = bytes.data();
    const auto plane = [&] { return std::exchange(next, next + kBlocks); };
    for (DecisionBytes& row : to) {
      row.clear_pixels = plane(), row.dark = plane();
      for (auto* planes : {&row.doubtful, &row.clear})
        for (std::uint8_t*& bits : *planes) bits = plane();
    }
    judge(pair_, begin, end, kLimits, to, rows);
    return bytes;
  }

  static constexpr DistortionLimits kLimits = {
      {{-0.3f, -9}, 60},
      {{{{-0.1f, -2}, 0.05f, 0.06f, 0.0008f, 1.2f}, {{-0.1f, -2}, 0.06f, 0.08f, 0.0009f, 1.7f}}},
      1.5f};
  std::vector<float> alpha_shift_, cd_sq_, alpha_weight_, inverse_sigma_;
  std::array<std::vector<float>, 3> cd_;
  std::vector<BlockSums> sums_;
  DistortionRowPair pair_;
};

std::vector<float> NumbersOf(const std::vector<BlockSums>& sums) {
  std::vector<float> numbers(sums.size() * sizeof(BlockSums) / sizeof(float));
  std::memcpy(numbers.data(), sums.data(), numbers.size() * sizeof(float));
  return numbers;
}

TEST_F(WindowKernels, LinesAreSummedAsPixelByPixel) {
  ExpectSameBits([&] { return NumbersOf(sums_); },
                 [&] { return NumbersOf(Summed(SumAlongLines)); });
}

TEST_F(WindowKernels, RunsAreJudgedAsPixelByPixel) {
  for (const int begin : {0, 16}) {
    for (int end = begin; end <= kWidth; ++end) {
      for (const int rows : {1, 2}) {
        ExpectSameBits([&] { return Judged(reference::JudgeWindows, begin, end, rows); },
                       [&] { return Judged(JudgeWindows, begin, end, rows); });
      }
    }
  }
  // Some of each kind.
  int planes = 0;
  const std::vector<std::uint8_t> bytes = Judged(reference::JudgeWindows, 0, kWidth, 2);
  for (std::size_t i = 0; i < bytes.size(); i += kBlocks) {
    const bool has_set = std::any_of(&bytes[i], &bytes[i] + kBlocks, [](int b) { return b != 0; });
    const bool has_clear =
        std::any_of(&bytes[i], &bytes[i] + kBlocks, [](int b) { return b != 0xff; });
    planes += has_set && has_clear;
  }
  EXPECT_EQ(planes, 12);
}

TEST_F(WindowKernels, WindowsAreNormalizedAsOneByOne) {
  for (std::size_t window = 0; window < kWindows; ++window) {
    const auto normalized = [&](const auto& normalize) {
      std::vector<float> numbers(6 * kWidth);
      const auto plane = [&](int i) { return &numbers[static_cast<std::size_t>(i * kWidth)]; };
      normalize({{{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}}});
      return numbers;
    };
    ExpectSameBits(
        [&] {
          return normalized([&](const std::array<WindowRow, 2>& to) {
            for (int row = 0; row < 2; ++row) {
              for (int x = 0; x < kWidth; ++x) {
                const auto d = reference::MeasureWindow(pair_, row, x, window);
                to[row].cd[x] = std::sqrt(d.cd_sq);
                to[row].alpha[x] = std::abs(d.alpha_shift) * pair_.rows[row].alpha_weight[x];
                to[row].roughness[x] = std::sqrt(std::max(d.roughness_sq, 0.0f));
              }
            }
          });
        },
        [&] {
          return normalized([&](const std::array<WindowRow, 2>& to) {
            NormalizeWindows(pair_, kBlocks, window, to);
          });
        });
  }
}

TEST_F(WindowKernels, SinglePixelsAreNormalizedOneByOne) {
  const auto normalized = [&](const auto& normalize) {
    std::vector<float> numbers(2 * kWidth);
    normalize(&numbers[0], &numbers[kWidth]);
    return numbers;
  };
  const DistortionRow& row = pair_.rows[0];
  ExpectSameBits(
      [&] {
        return normalized([&](float* cd, float* darker) {
          for (int x = 0; x < kWidth; ++x) {
            cd[x] = std::sqrt(row.cd_sq[x]);
            darker[x] = -row.alpha_shift[x] * row.alpha_weight[x];
          }
        });
      },
      [&] {
        return normalized(
            [&](float* cd, float* darker) { NormalizePixels(row, kWidth, cd, darker); });
      });
}

}  // namespace
}  // namespace mocap::kernels
