// Memory that the process has freed.
#pragma once

#include <malloc.h>

namespace mocap {

/// Returns to the system what the C library keeps of freed memory. Call after work that took much:
/// by itself, the library returns only what lies at the end of its heap. Takes some milliseconds.
/// It holds the lock of each of the library's arenas meanwhile, one after the other: a thread that
/// allocates or frees memory of that arena waits, a realtime one too.
inline void GiveBackFreeMemory() { malloc_trim(0); }

}  // namespace mocap
