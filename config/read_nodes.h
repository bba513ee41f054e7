// Configuration of several computers: a node itself, and the nodes of a studio.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "config/toml_section.h"

namespace mocap {

/// Reads `role`, [node] and [[nodes]]. @throws SetupError  also for settings of another role, and
/// for two nodes or cameras with the same name.
void ReadRole(TomlSection& root, Config& config);

/// @throws SetupError  for what the role needs and the configuration lacks.
void CheckRole(const TomlSection& root, const Config& config);

}  // namespace mocap
