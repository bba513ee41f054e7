// The configuration that a command uses.
#pragma once

#include <filesystem>

#include "config/config.h"

namespace mocap {

/// The installed configuration, of the system's daemon.
inline constexpr const char* kSystemConfig = MOCAP_CONFIG_FILE;

/// Loads the named configuration; without a name, the system's if installed, or the defaults.
/// @throws SetupError  for an invalid one.
Config LoadChosenConfig(const std::filesystem::path& named);

}  // namespace mocap
