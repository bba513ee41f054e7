// Going before everything else on a busy machine, as far as limits allow.
#pragma once

#include "config/service_config.h"

namespace mocap {

/// Locks memory and looks whether threads may have the priority that is wished.
/// @throws SetupError  naming the limit that stands against it.
void PrepareRealtime(const RealtimeConfig& config);

}  // namespace mocap
