// `mocap cameras`: what is connected, and whether it works.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Registers the subcommand; it runs when it is chosen on the command line.
void AddCamerasCommand(CLI::App& app);

}  // namespace mocap
