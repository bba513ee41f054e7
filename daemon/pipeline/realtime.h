// Gives the daemon precedence on a busy machine, as far as limits allow.
#pragma once

#include <vector>

#include "config/service_config.h"

namespace mocap {

/// Locks memory, and tests whether threads may have the configured priority and processors.
/// @throws SetupError  naming the limit that prevents it.
void PrepareRealtime(const RealtimeConfig& config);

/// Restricts the calling thread to these processors; an empty list is no restriction.
/// @return  false if not possible.
bool KeepToProcessors(const std::vector<int>& processors);

/// Of the frame path if none is configured. It is below the threads that receive packets of network
/// cameras, which have 10.
constexpr int kUsualPriority = 5;

/// The configured priority of the frame path. Without one, kUsualPriority if the limits allow it,
/// and otherwise normal scheduling (0).
int FramePathPriority(const RealtimeConfig& config);

/// Gives the calling thread SCHED_FIFO priority; 0: normal scheduling.
/// @return  false if the limits do not allow it.
bool TakePriority(int priority);

/// Whether the calling thread, which has normal priority, may take this one.
bool MayTakePriority(int priority);

/// Gives the calling thread long time slices although others are ready, for throughput without
/// deadlines: begun work is not left half done. Before Linux 6.12 it only prevents preemption by
/// threads that wake up.
void WorkInLongTurns();

}  // namespace mocap
