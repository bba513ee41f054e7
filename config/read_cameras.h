// The [[cameras]] of a live studio.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "config/toml_section.h"

namespace mocap {

/// Reads [[cameras]]: the common settings, and those of the named driver. If the driver is not a
/// live one, the settings of all drivers are accepted, so that a studio can be replayed without
/// removing them.
/// @throws SetupError  also for two cameras with the same name or device.
std::vector<CameraConfig> ReadCameras(TomlSection& root, const std::string& driver);

}  // namespace mocap
