// `mocap export`: converts a result for other programs.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand `export RESULT --format FORMAT --out FILE`.
void AddExportCommand(CLI::App& app);

}  // namespace mocap
