// The part of the configuration that concerns the daemon as a service.
#pragma once

#include <filesystem>

#include "config/service_config.h"
#include "config/toml_section.h"

namespace mocap {

/// Reads [control], [recording], [metrics] and [realtime] of the daemon's file. Relative paths are
/// resolved against the file's folder. @throws SetupError
ServiceConfig ReadServiceConfig(TomlSection& root, const std::filesystem::path& file);

}  // namespace mocap
