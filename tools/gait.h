// `mocap gait`: events and figures of people who walk.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand `gait RESULT [--out FOLDER] [--report HTML] [--prefix NAME] [--people]
/// [--json]`.
void AddGaitCommand(CLI::App& app);

}  // namespace mocap
