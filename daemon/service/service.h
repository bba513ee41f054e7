// The daemon from its configuration to its last message.
#pragma once

#include <filesystem>
#include <optional>

#include "config/config.h"

namespace mocap {

/// Captures and publishes until the source ends, a signal comes or the time is over; SIGHUP reads
/// the configuration again.
/// @param file     the configuration; without one, the simulated studio.
/// @param seconds  how long to run at most.
/// @throws SetupError  when the studio, its cameras or LCM cannot be used as configured.
void RunService(const std::optional<std::filesystem::path>& file, std::optional<double> seconds);

}  // namespace mocap
