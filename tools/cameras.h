// `mocap cameras`: lists connected cameras and checks them.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand; it runs when chosen on the command line.
void AddCamerasCommand(CLI::App& app);

}  // namespace mocap
