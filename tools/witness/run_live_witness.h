// `mocap witness` without a take.
#pragma once

#include "tools/witness/live_witness.h"
#include "tools/witness/pose_network.h"

namespace mocap {

/// Runs a witness at the lowest priority until a signal asks it to end (StopOnSignals). Says when
/// no mocapd is heard, and on a terminal every few seconds what it does.
/// @throws SetupError  that names --url, for an address where nothing can be received.
void RunLiveWitness(const LiveWitnessOptions& options, PoseNetwork& network);

}  // namespace mocap
