// mocap view: shows the studio or a take in a browser.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

/// Adds the subcommand; it runs when parsed.
void AddViewCommand(CLI::App& app);

}  // namespace mocap
