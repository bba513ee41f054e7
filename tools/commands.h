// All commands of mocap.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddCommands(CLI::App& app);

}  // namespace mocap
