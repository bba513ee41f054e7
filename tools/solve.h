// mocap solve: the best that a recorded take can give.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddSolveCommand(CLI::App& app);

}  // namespace mocap
