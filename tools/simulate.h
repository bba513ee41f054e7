// `mocap simulate`: makes a take of the simulated studio.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand; it runs when chosen on the command line.
void AddSimulateCommand(CLI::App& app);

}  // namespace mocap
