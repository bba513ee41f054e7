// Background work of lowest priority, until someone waits for it.
#pragma once

#include <string>
#include <thread>

namespace mocap {

/// Names the calling thread and moves it to SCHED_IDLE, so that it runs only on an idle processor.
/// A merely nicer thread would finish its time slice of some milliseconds before a frame is
/// handled.
void GoBehind(const std::string& name);

/// Whether a SCHED_IDLE thread may be raised again. This requires CAP_SYS_NICE, or a niceness limit
/// (RLIMIT_NICE) that allows the threads' initial niceness.
bool MayComeForward();

/// Gives such a thread the scheduling of the calling thread.
/// @return  false if that is not permitted.
bool BringForward(std::thread& thread);

/// Reverts BringForward.
void SendBehind(std::thread& thread);

}  // namespace mocap
