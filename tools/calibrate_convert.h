// `mocap calibrate convert`.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddConvert(CLI::App* parent);

}  // namespace mocap
