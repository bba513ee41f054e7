// §4: eight adjacent pixels of a row, and their expected values.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "core/lanes.h"

namespace mocap {

/// Loads eight pixels. The channels of each are the bytes of one number: blue in the lowest, then
/// green and red. The highest byte is undefined.
MOCAP_INLINE void LoadPixels(const Bgr* from, Ints& pixels) {
  using Bytes = std::uint8_t __attribute__((vector_size(sizeof(Ints))));
  constexpr int kHalf = sizeof(Bytes) / 2;
  // The last four pixels end where the second half does.
  static_assert(kFloats * sizeof(Bgr) == 24 && kHalf == 16);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(from);
  std::uint8_t __attribute__((vector_size(kHalf))) first, last;
  LoadLanes(bytes, first), LoadLanes(bytes + 8, last);
  const Bytes both =
      __builtin_shufflevector(first, last, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16,
                              17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31);
  pixels = reinterpret_cast<Ints>(
      __builtin_shufflevector(both, both, 0, 1, 2, 2, 3, 4, 5, 5, 6, 7, 8, 8, 9, 10, 11, 11, 20, 21,
                              22, 22, 23, 24, 25, 25, 26, 27, 28, 28, 29, 30, 31, 31));
}

/// Returns one channel of loaded pixels.
MOCAP_INLINE Floats ChannelOf(Ints pixels, int channel) {
  return ToFloats(pixels >> 8 * channel & 0xff);
}

/// Loads eight values that are stored as integers, in units of `unit`.
MOCAP_INLINE Floats LoadShorts(const std::uint16_t* from, float unit) {
  using Shorts = std::uint16_t __attribute__((vector_size(kFloats * sizeof(std::uint16_t))));
  Shorts shorts;
  LoadLanes(from, shorts);
#ifdef __x86_64__
  // Interleaved with zeros they are integers. GCC 12 compiles a conversion to two halves, but this
  // to one instruction, where vectors are wide enough.
  const auto wide = reinterpret_cast<Ints>(__builtin_shufflevector(
      shorts, Shorts{}, 0, 8, 1, 9, 2, 10, 3, 11, 4, 12, 5, 13, 6, 14, 7, 15));
#else
  const auto wide = __builtin_convertvector(shorts, Ints);
#endif
  return ToFloats(wide) * unit;
}

}  // namespace mocap
