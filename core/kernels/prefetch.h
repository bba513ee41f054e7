// Memory that is needed soon.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/image.h"

namespace mocap {

/// Prefetches memory that is needed soon.
inline void FetchBytes(const void* from, std::size_t count) {
  constexpr std::size_t kCacheLine = 64;
  for (std::size_t i = 0; i < count; i += kCacheLine)
    __builtin_prefetch(static_cast<const std::uint8_t*>(from) + i);
}

/// Prefetches pixels [begin, end) of a row that are needed soon, if the image has that row. Short
/// pieces of rows end before the processor's own prefetching has found the next.
template <typename T>
void FetchPixels(ImageView<const T> image, int y, int begin, int end) {
  if (y < image.height()) FetchBytes(image.row(y) + begin, (end - begin) * sizeof(T));
}

}  // namespace mocap
