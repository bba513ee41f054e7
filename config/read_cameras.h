// The [[cameras]] of a live studio.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "config/toml_section.h"

namespace mocap {

/// Reads [[cameras]]: what all cameras have, and the settings of the driver named. Where that is no
/// live one, all settings are known, so that a studio can be replayed without taking them out.
/// @throws SetupError  also for two cameras of one name or device.
std::vector<CameraConfig> ReadCameras(TomlSection& root, const std::string& driver);

}  // namespace mocap
