// Counts what a thread takes from the heap.
#pragma once

#include <cstdint>

namespace mocap {

// GCC says it by macros, Clang by features; Eigen defines the latter's question for everybody.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MOCAP_HAS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MOCAP_HAS_SANITIZER
#endif
#endif

#ifdef MOCAP_HAS_SANITIZER
constexpr bool kCountsAllocations = false;
#else
constexpr bool kCountsAllocations = true;
#endif

/// Allocations of this thread so far, by whatever function. With a sanitizer always 0.
std::int64_t Allocations();

}  // namespace mocap
