// Measures what the process keeps.
#pragma once

#include <malloc.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>

#include "tests/support/allocation_counter.h"

namespace mocap {

/// What all threads have taken from the heap and not given back. With a sanitizer always 0.
inline std::int64_t HeapBytes() {
  if (!kCountsAllocations) return 0;
  const auto heap = mallinfo2();
  return static_cast<std::int64_t>(heap.uordblks + heap.hblkhd);
}

/// Memory of the process that the system holds.
inline std::int64_t ResidentBytes() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace mocap
