// `mocap calibrate check`: assesses a calibration.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddCheck(CLI::App* parent);

}  // namespace mocap
