// Several computers: what a node is, and which nodes a studio has.
#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "config/toml_section.h"

namespace mocap {

/// Reads `role`, [node] and [[nodes]]. @throws SetupError  also for what belongs to another role,
/// and for two nodes or cameras of one name.
void ReadRole(TomlSection& root, Config& config);

}  // namespace mocap
