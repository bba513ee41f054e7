// Measures what the process keeps.
#pragma once

#include <malloc.h>

#include <cstdint>

#include "tests/support/allocation_counter.h"

namespace mocap {

/// What all threads have taken from the heap and not given back. With a sanitizer always 0.
inline std::int64_t HeapBytes() {
  if (!kCountsAllocations) return 0;
  const auto heap = mallinfo2();
  return static_cast<std::int64_t>(heap.uordblks + heap.hblkhd);
}

}  // namespace mocap
