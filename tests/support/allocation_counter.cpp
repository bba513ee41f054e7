#include "tests/support/allocation_counter.h"

#include <cstddef>

namespace {

thread_local std::int64_t allocations = 0;

}  // namespace

namespace mocap {

std::int64_t Allocations() { return allocations; }

}  // namespace mocap

// The C library's own under their other names; operator new calls the former.
#ifndef MOCAP_HAS_SANITIZER
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) noexcept {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif
