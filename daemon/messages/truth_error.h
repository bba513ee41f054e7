// Compares a tracked set with ground truth.
#pragma once

#include <functional>

#include "daemon/pipeline/pose_sink.h"
#include "drivers/virtual_studio/studio_options.h"

namespace mocap {

/// Mean distance of the set's points from their true positions [mm].
using TruthError = std::function<double(const TrackedSet& set)>;

/// Compares the joints that the simulation and the body model share, by name.
TruthError SimulatedTruthError(const SimulatedStudioOptions& options);

}  // namespace mocap
