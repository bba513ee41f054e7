// Going before everything else on a busy machine, as far as limits allow.
#pragma once

#include <string>

#include "config/service_config.h"

namespace mocap {

/// Locks memory and looks whether threads may have the priority that is wished.
/// @throws SetupError  naming the limit that stands against it.
void PrepareRealtime(const RealtimeConfig& config);

/// Names the calling thread and puts it behind the pipeline's.
void StepBehind(const std::string& name);

}  // namespace mocap
