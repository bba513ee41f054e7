// mocap watch: shows the running system live in a terminal.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddWatchCommand(CLI::App& app);

}  // namespace mocap
