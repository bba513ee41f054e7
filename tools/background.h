// `mocap background`: the live cameras' pictures of the empty studio.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand; it runs when chosen on the command line.
void AddBackgroundCommand(CLI::App& app);

}  // namespace mocap
