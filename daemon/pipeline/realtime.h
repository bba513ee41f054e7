// Going before everything else on a busy machine, as far as limits allow.
#pragma once

#include <vector>

#include "config/service_config.h"

namespace mocap {

/// Locks memory and looks whether threads may have the priority and the processors that are wished.
/// @throws SetupError  naming the limit that stands against it.
void PrepareRealtime(const RealtimeConfig& config);

/// Keeps the calling thread to these processors; to none in particular when there are none.
/// @return  false where that is not possible.
bool KeepToProcessors(const std::vector<int>& processors);

/// Lets the calling thread go before others, by SCHED_FIFO; 0: as everybody.
/// @return  false where the limits do not allow it.
bool TakePriority(int priority);

/// Lets the calling thread work on for long when others are ready as well, where none is in a
/// hurry: what it has begun is not left lying about half done. Before Linux 6.12 only who wakes up
/// no longer interrupts it.
void WorkInLongTurns();

}  // namespace mocap
