// §4: the 2 × 2 × 2 samples of eight voxels in one word: one byte per sample, one bit per voxel.
#pragma once

#include <cstdint>

namespace mocap {

inline constexpr int kSamplesPerSide = 2;
inline constexpr int kSamples = kSamplesPerSide * kSamplesPerSide * kSamplesPerSide;
inline constexpr int kMajority = kSamples / 2 + 1;

/// Moves each bit to the lowest bit of its own byte.
constexpr std::uint64_t SpreadBits(std::uint8_t bits) {
  return ((bits & 0x7fu) * 0x02040810204081u & 0x0101010101010101u) | std::uint64_t{bits & 0x80u}
                                                                          << 49;
}

/// Finds which voxels have a majority of their samples. Adds all voxels at once, bit-sliced,
/// halving the bytes in each step.
constexpr std::uint8_t Majorities(std::uint64_t samples) {
  static_assert(kSamples == 8 && kMajority == 5);
  const std::uint64_t a = samples >> 32;
  std::uint64_t ones = samples ^ a, twos = samples & a;
  const std::uint64_t b = ones >> 16, c = twos >> 16;
  const std::uint64_t carry = ones & b, either = twos ^ c;
  ones ^= b;
  std::uint64_t fours = (twos & c) | (either & carry);
  twos = either ^ carry;
  const std::uint64_t d = ones >> 8, e = twos >> 8, f = fours >> 8;
  const std::uint64_t carry_two = ones & d, any_two = twos ^ e;
  ones ^= d;
  const std::uint64_t carry_four = (twos & e) | (any_two & carry_two);
  twos = any_two ^ carry_two;
  const std::uint64_t eights = (fours & f) | ((fours ^ f) & carry_four);
  fours ^= f ^ carry_four;
  return static_cast<std::uint8_t>(eights | (fours & (twos | ones)));
}

/// The samples of one voxel, one bit per sample.
constexpr std::uint8_t SamplesOf(std::uint64_t samples, int voxel) {
  return static_cast<std::uint8_t>((samples >> voxel & 0x0101010101010101) * 0x0102040810204080 >>
                                   56);
}

}  // namespace mocap
