// Work that nobody waits for.
#pragma once

#include <string>

namespace mocap {

/// Names the calling thread and lets it have the processor when nobody else wants it (SCHED_IDLE):
/// a thread that is only nicer finishes its slice of some milliseconds before a frame is looked at.
void GoBehind(const std::string& name);

}  // namespace mocap
