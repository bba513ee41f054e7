// mocap track: runs the daemon's pipeline on a take.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand; it runs when parsed.
void AddTrackCommand(CLI::App& app);

}  // namespace mocap
