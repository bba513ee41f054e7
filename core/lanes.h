// Numbers side by side, for loops whose choices the compiler would make branches of.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/vectorized.h"

/// Stands before a function that becomes part of vectorized ones, and so has as many versions.
#define MOCAP_INLINE inline __attribute__((always_inline))

namespace mocap {

/// So many numbers side by side, for what the compiler would make branches of. They live in
/// registers only, because how they lie in memory depends on the processor: there they are arrays.
/// How they are handed over depends on it as well: functions that take or give them are
/// MOCAP_INLINE.
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
MOCAP_INLINE void ClampLanes(Lanes& x, Number low, Number high) {
  x = x < low ? Lanes{} + low : x;
  x = x > high ? Lanes{} + high : x;
}
template <typename Lanes>
MOCAP_INLINE void TakeRoots(Lanes& x) {
  alignas(32) std::remove_reference_t<decltype(x[0])> numbers[sizeof(Lanes) / sizeof x[0]];
  StoreLanes(x, numbers);
#pragma GCC unroll 1
  for (auto& number : numbers) number = std::sqrt(number);
  LoadLanes(numbers, x);
}

}  // namespace mocap
