// mocap benchmark: how accurate tracking is, on simulated people.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddBenchmarkCommand(CLI::App& app);

}  // namespace mocap
