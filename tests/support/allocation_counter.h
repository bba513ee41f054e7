// Counts what a thread takes from the heap.
#pragma once

#include <cstdint>

namespace mocap {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCountsAllocations = false;
#else
constexpr bool kCountsAllocations = true;
#endif

/// Allocations of this thread so far, by whatever function. With a sanitizer always 0.
std::int64_t Allocations();

}  // namespace mocap
