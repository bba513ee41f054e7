// mocap ask: one request by standard input, for other computers.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddAskCommand(CLI::App& app);

}  // namespace mocap
