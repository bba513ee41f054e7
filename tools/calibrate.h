// `mocap calibrate`: from pictures of a board to calibration.toml.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddCalibrateCommand(CLI::App& app);

}  // namespace mocap
