// How far a tracked set is from the truth.
#pragma once

#include <functional>

#include "daemon/pipeline/pose_sink.h"
#include "drivers/simulation/simulated_studio.h"

namespace mocap {

/// Mean distance of the set's points from their true places [mm].
using TruthError = std::function<double(const TrackedSet& set)>;

/// Compares the joints that the simulation and the body's model have in common, by name.
TruthError SimulatedTruthError(const SimulatedStudioOptions& options);

}  // namespace mocap
