// The configuration that a command uses.
#pragma once

#include <filesystem>

#include "config/config.h"

namespace mocap {

/// Returns where the configuration of the system's daemon is, if it is installed: in etc of this
/// program's prefix, as systemd/install_folders.cmake.in decides.
std::filesystem::path SystemConfig();

/// Loads the named configuration; without a name, the system's if installed, or the defaults.
/// @throws SetupError  for an invalid one.
Config LoadChosenConfig(const std::filesystem::path& named);

}  // namespace mocap
