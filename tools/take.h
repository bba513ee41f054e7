// mocap take: operations on recorded takes.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddTakeCommand(CLI::App& app);

}  // namespace mocap
