// mocap ask: one request on standard input, for other computers.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddAskCommand(CLI::App& app);

}  // namespace mocap
