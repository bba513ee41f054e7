#include "core/kernels/expected_pixels.h"

#include <algorithm>
#include <cmath>

#include "tests/core/kernels/each_target.h"

namespace mocap::kernels {
namespace {

// Planes of random numbers for a row of pixels.
class ExpectedPixelKernels : public ::testing::TestWithParam<std::size_t> {
 protected:
  ExpectedPixelKernels() : count_(GetParam()), bytes_(numbers_.Integers<std::uint8_t>(count_)) {
    for (std::size_t i = 0; i < count_; ++i) {
      const auto level = [&] { return static_cast<std::uint8_t>(numbers_.Below(256)); };
      pixels_.push_back({level(), level(), level()});
    }
    for (int c = 0; c < 3; ++c) {
      mean_[c] = numbers_.Floats(count_, 1, 255), variance_[c] = numbers_.Floats(count_, 2, 90);
      // Sums over ten frames.
      value_[c] = numbers_.Floats(count_, 0, 2550), value_sq_[c] = value_[c];
      for (float& square : value_sq_[c])
        square = square * square / 10 + static_cast<float>(numbers_.Below(200) - 20);
    }
    first_ = numbers_.Floats(count_, 0, 50), second_ = numbers_.Floats(count_, 0, 50);
  }
  int count() const { return static_cast<int>(count_); }
  static std::array<const float*, 3> Planes(const std::array<std::vector<float>, 3>& planes) {
    return {planes[0].data(), planes[1].data(), planes[2].data()};
  }
  // Copies two planes, calls fill(first, second), and joins them.
  template <typename Fill>
  std::vector<float> Both(const Fill& fill) const {
    std::vector<float> first = first_, second = second_;
    fill(first.data(), second.data());
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }

  std::size_t count_;
  Numbers numbers_{9};
  std::vector<std::uint8_t> bytes_;
  std::vector<Bgr> pixels_;
  std::array<std::vector<float>, 3> mean_, variance_, value_, value_sq_;
  std::vector<float> first_, second_;
};

TEST_P(ExpectedPixelKernels, ValuesAreAddedOneByOne) {
  ExpectSameBits(
      [&] {
        return Both([&](float* sum, float* sum_sq) {
          for (std::size_t i = 0; i < count_; ++i) {
            const float value = pixels_[i].b * 1.1f;
            sum[i] += -1 * value, sum_sq[i] += -1 * value * value;
          }
        });
      },
      [&] {
        return Both([&](float* sum, float* sum_sq) {
          AddValues(&pixels_[0].b, count(), 1.1f, -1, sum, sum_sq);
        });
      });
}

TEST_P(ExpectedPixelKernels, PixelsAreLearnedOneByOne) {
  constexpr float kFrames = 10, kShift_px = 0.3f;
  const auto learned = [&](const auto& learn) {
    std::vector<float> planes(6 * count_);
    const auto plane = [&](std::size_t i) { return &planes[i * count_]; };
    learn(LearnedPixels{
        {plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}, bytes_.data()});
    return planes;
  };
  ExpectSameBits(
      [&] {
        return learned([&](const LearnedPixels& to) {
          for (std::size_t i = 0; i < count_; ++i) {
            for (int c = 0; c < 3; ++c) {
              const float mean = value_[c][i] / kFrames;
              const float spread =
                  (value_sq_[c][i] / kFrames - mean * mean) * kFrames / (kFrames - 1);
              const float shift = kShift_px * bytes_[i];
              to.mean[c][i] = std::max(mean, kDarkestMean);
              to.variance[c][i] = std::max(spread, 2.25f) + shift * shift;
            }
          }
        });
      },
      [&] {
        return learned([&](const LearnedPixels& to) {
          ExpectPixels({Planes(value_), Planes(value_sq_)}, count(), kFrames, kShift_px, to);
        });
      });
}

TEST_P(ExpectedPixelKernels, DrawnPixelsAreFinishedOneByOne) {
  std::vector<std::uint8_t> is_known = bytes_;
  for (std::uint8_t& known : is_known) known &= 1;
  ExpectSameBits(
      [&] {
        return Both([&](float* mean, float* variance) {
          for (std::size_t i = 0; i < count_; ++i) {
            mean[i] = is_known[i] != 0 ? std::max(mean[i], kDarkestMean) : 255;
            variance[i] = is_known[i] != 0 ? 4.5f : 1e8f;
          }
        });
      },
      [&] {
        return Both([&](float* mean, float* variance) {
          FinishDrawn(is_known.data(), count(), 4.5f, 1e8f, mean, variance);
        });
      });
}

TEST_P(ExpectedPixelKernels, GroupsAreWeighedPixelByPixel) {
  constexpr int kPixels = WeighedPixels::kPixels;
  const int groups = count() / kPixels;
  if (groups == 0) return;
  const auto weighed = [&](const auto& weigh) {
    std::vector<WeighedPixels> to(static_cast<std::size_t>(3 * groups));
    weigh(to.data());
    std::vector<std::uint16_t> numbers(to.size() * sizeof(WeighedPixels) / 2);
    std::memcpy(numbers.data(), to.data(), numbers.size() * 2);
    return numbers;
  };
  const auto rounded = [](float value) {
    return static_cast<std::uint16_t>(std::min(value, 65535.0f) + 0.5f);
  };
  ExpectSameBits(
      [&] {
        return weighed([&](WeighedPixels* to) {
          for (int i = 0; i < groups * kPixels; ++i) {
            WeighedPixels& group = to[i / kPixels * 3];
            const int k = i % kPixels;
            const float slope = bytes_[i];
            float square = 0;
            for (int c = 0; c < 3; ++c) {
              const float weight = 1 / (variance_[c][i] + 0.2f * slope * slope);
              square += mean_[c][i] * mean_[c][i] * weight;
              group.mean[c][k] = rounded(mean_[c][i] / WeighedPixels::kMeanUnit);
              group.inverse_sigma[c][k] =
                  rounded(std::sqrt(weight) / WeighedPixels::kInverseSigmaUnit);
            }
            group.alpha_weight[k] = rounded(std::sqrt(square) / WeighedPixels::kAlphaWeightUnit);
          }
        });
      },
      [&] {
        return weighed([&](WeighedPixels* to) {
          WeighPixels({Planes(mean_), Planes(variance_), bytes_.data()}, groups, 0.2f, to, 3);
        });
      });
}

INSTANTIATE_TEST_SUITE_P(RowsOfAnyLength, ExpectedPixelKernels,
                         ::testing::Values(1, 2, 7, 16, 33, 64, 101));

}  // namespace
}  // namespace mocap::kernels
