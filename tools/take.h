// mocap take: what is done with recorded takes as such.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddTakeCommand(CLI::App& app);

}  // namespace mocap
