// mocap benchmark: measures tracking accuracy on simulated people.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddBenchmarkCommand(CLI::App& app);

}  // namespace mocap
