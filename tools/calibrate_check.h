// `mocap calibrate check`: what a calibration is worth.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddCheck(CLI::App* parent);

}  // namespace mocap
