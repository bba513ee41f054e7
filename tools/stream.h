// `mocap stream`: sends live poses to other programs.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommands `stream json` and `stream osc`.
void AddStreamCommand(CLI::App& app);

}  // namespace mocap
