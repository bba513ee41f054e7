// `mocap simulate`: a take from the simulated studio.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Registers the subcommand; it runs when it is chosen on the command line.
void AddSimulateCommand(CLI::App& app);

}  // namespace mocap
