// Runs kernels for each kind of processor that this one can stand in for.
#pragma once

#include "core/kernels/targets.h"
// Reads what the line above defines.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <vector>

namespace mocap::kernels {

/// Calls `test` once for each version of the kernels that this processor can execute.
template <typename Test>
void ForEachTarget(const Test& test) {
  const auto choose = [](std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  };
  choose(0);
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    SCOPED_TRACE(hwy::TargetName(target));
    choose(target);
    test();
  }
  choose(0);
}

/// Returns the bits of numbers, which tell zeros with different signs and NaNs from each other.
template <typename Number>
std::vector<std::uint8_t> BitsOf(const std::vector<Number>& numbers) {
  std::vector<std::uint8_t> bytes(numbers.size() * sizeof(Number));
  if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// Runs `compute` on each target and expects the same numbers, bit for bit, as from `reference`.
/// Both return a vector of numbers.
template <typename Reference, typename Compute>
void ExpectSameBits(const Reference& reference, const Compute& compute) {
  const auto wanted = reference();
  ASSERT_FALSE(wanted.empty());
  ForEachTarget([&] {
    const auto computed = compute();
    ASSERT_EQ(computed.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (std::memcmp(&computed[i], &wanted[i], sizeof wanted[i]) == 0) continue;
      ADD_FAILURE() << "number " << i << " is " << +computed[i] << " instead of " << +wanted[i];
      return;
    }
  });
}

/// Makes random numbers, always the same.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed = 1) : random_(seed) {}

  template <typename Number>
  std::vector<Number> Integers(std::size_t count) {
    std::vector<Number> numbers(count);
    for (Number& number : numbers) number = static_cast<Number>(random_());
    return numbers;
  }
  std::vector<float> Floats(std::size_t count, float low, float high) {
    std::uniform_real_distribution<float> some(low, high);
    std::vector<float> numbers(count);
    for (float& number : numbers) number = some(random_);
    return numbers;
  }
  std::vector<double> Doubles(std::size_t count, double low, double high) {
    std::uniform_real_distribution<double> some(low, high);
    std::vector<double> numbers(count);
    for (double& number : numbers) number = some(random_);
    return numbers;
  }
  int Below(int end) { return static_cast<int>(random_() % static_cast<std::uint32_t>(end)); }

 private:
  std::mt19937_64 random_;
};

}  // namespace mocap::kernels
