// Small vectors of numbers, for loops whose choices the compiler would turn into branches.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "core/vectorized.h"

/// Marks a function that is inlined into vectorized ones, and so has as many versions.
#define MOCAP_INLINE inline __attribute__((always_inline))

namespace mocap {

/// Vectors of numbers, where the compiler would produce branches. They live in registers only,
/// because their layout in memory depends on the processor; there they are arrays. The calling
/// convention depends on it too: functions that take or return them are MOCAP_INLINE.
using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
inline constexpr int kFloats = 8;
using Doubles = double __attribute__((vector_size(32)));
inline constexpr int kDoubles = 4;

template <typename Lanes, typename Number>
MOCAP_INLINE void LoadLanes(const Number* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof lanes);
}
template <typename Lanes, typename Number>
MOCAP_INLINE void StoreLanes(const Lanes& lanes, Number* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}
template <typename Lanes, typename Number>
MOCAP_INLINE Lanes Clamped(Lanes x, Number low, Number high) {
  x = x < low ? Lanes{} + low : x;
  return x > high ? Lanes{} + high : x;
}
template <typename Lanes>
MOCAP_INLINE void TakeRoots(Lanes& x) {
  alignas(32) std::remove_reference_t<decltype(x[0])> numbers[sizeof(Lanes) / sizeof x[0]];
  StoreLanes(x, numbers);
#pragma GCC unroll 1
  for (auto& number : numbers) number = std::sqrt(number);
  LoadLanes(numbers, x);
}

/// The smaller, or the larger number, lane by lane.
template <typename Lanes>
MOCAP_INLINE Lanes Least(Lanes a, Lanes b) {
  return a < b ? a : b;
}
template <typename Lanes>
MOCAP_INLINE Lanes Most(Lanes a, Lanes b) {
  return a < b ? b : a;
}
/// The same number in every lane. GCC 12 would add an integer to zeros one lane at a time.
MOCAP_INLINE Floats AllOf(float number) { return Floats{} + number; }
MOCAP_INLINE Ints AllOf(int number) {
  Ints first{};
  first[0] = number;
  return __builtin_shufflevector(first, first, 0, 0, 0, 0, 0, 0, 0, 0);
}
MOCAP_INLINE Floats SizeOf(Floats x) {
  return reinterpret_cast<Floats>(reinterpret_cast<Ints>(x) & 0x7fffffff);
}
MOCAP_INLINE Ints TowardsZero(Floats x) { return __builtin_convertvector(x, Ints); }
MOCAP_INLINE Floats ToFloats(Ints x) { return __builtin_convertvector(x, Floats); }

/// Returns all bits that are set in any lane.
MOCAP_INLINE unsigned UnionOf(Ints bits) {
  using Half = std::int32_t __attribute__((vector_size(sizeof(Ints) / 2)));
  Half united = __builtin_shufflevector(bits, bits, 0, 1, 2, 3) |
                __builtin_shufflevector(bits, bits, 4, 5, 6, 7);
  united |= __builtin_shufflevector(united, united, 2, 3, 0, 1);
  return static_cast<unsigned>(united[0] | united[1]);
}
/// Converts selected lanes to bits, the first lane in the lowest bit, and back.
MOCAP_INLINE Ints PlaceBits() { return Ints{1, 2, 4, 8, 16, 32, 64, 128}; }
MOCAP_INLINE unsigned BitsOf(Ints choice) {
#ifdef __SSE2__
  using Half = std::int32_t __attribute__((vector_size(sizeof(Ints) / 2)));
  const auto signs = [](Half half) {
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(half)));
  };
  return signs(__builtin_shufflevector(choice, choice, 0, 1, 2, 3)) |
         signs(__builtin_shufflevector(choice, choice, 4, 5, 6, 7)) << 4;
#else
  return UnionOf(choice & PlaceBits());
#endif
}
MOCAP_INLINE Ints ChoiceOf(unsigned bits) {
  return (AllOf(static_cast<int>(bits)) & PlaceBits()) == PlaceBits();
}

/// Indices of eight table entries. They pass through memory, because extracting them from a
/// register one by one occupies the units that shuffle.
struct Places {
  MOCAP_INLINE explicit Places(Ints places) {
    StoreLanes(places, at.data());
    asm("" : "+m"(at));  // Otherwise compilers know that they are still in a register.
  }
  alignas(32) std::array<std::int32_t, kFloats> at;
};
MOCAP_INLINE Ints LookUp(const std::uint32_t* words, const Places& places) {
  const auto word = [&](int i) { return static_cast<std::int32_t>(words[places.at[i]]); };
  return Ints{word(0), word(1), word(2), word(3), word(4), word(5), word(6), word(7)};
}
MOCAP_INLINE Floats LookUp(const float* numbers, const Places& places) {
  const auto number = [&](int i) { return numbers[places.at[i]]; };
  return Floats{number(0), number(1), number(2), number(3),
                number(4), number(5), number(6), number(7)};
}

}  // namespace mocap
