// `mocap calibrate`: computes calibration.toml from pictures of a board.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddCalibrateCommand(CLI::App& app);

}  // namespace mocap
