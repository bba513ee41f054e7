// Work that nobody waits for, until somebody does.
#pragma once

#include <string>
#include <thread>

namespace mocap {

/// Names the calling thread and lets it have the processor when nobody else wants it (SCHED_IDLE):
/// a thread that is only nicer finishes its slice of some milliseconds before a frame is looked at.
void GoBehind(const std::string& name);

/// Whether a thread that went behind may come forward again: that takes CAP_SYS_NICE, or a limit of
/// niceness (RLIMIT_NICE) that allows what threads have to begin with.
bool MayComeForward();

/// Lets a thread that went behind run as the calling one does.
/// @return  false where that is not permitted.
bool BringForward(std::thread& thread);

/// Ends that.
void SendBehind(std::thread& thread);

}  // namespace mocap
