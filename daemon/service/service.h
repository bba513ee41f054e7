// Runs the daemon from its configuration to its last message.
#pragma once

#include <filesystem>
#include <optional>

#include "config/config.h"

namespace mocap {

/// Captures and publishes until the source ends, a signal comes or the time is over. SIGHUP reloads
/// the configuration.
/// @param file     the configuration; without one, the simulated studio.
/// @param seconds  maximum run time.
/// @throws SetupError  if the studio, its cameras or LCM cannot be used as configured.
void RunService(const std::optional<std::filesystem::path>& file, std::optional<double> seconds);

}  // namespace mocap
