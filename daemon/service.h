// The daemon from its configuration to its last message.
#pragma once

#include <optional>

#include "config/config.h"

namespace mocap {

/// Holds back SIGINT and SIGTERM from all threads that start afterwards, so that RunService can
/// wait for them. Call first in main.
void HoldSignals();

/// Captures and publishes until the source ends, a signal comes or the time is over.
/// @param seconds  how long to run at most.
/// @throws SetupError  when the studio, its cameras or LCM cannot be used as configured.
void RunService(const Config& config, std::optional<double> seconds);

/// Looks whether RunService could begin, without cameras or LCM. @throws SetupError
void CheckConfig(const Config& config);

}  // namespace mocap
