// `mocap calibrate board`: prints a board.
#pragma once

#include <CLI/CLI.hpp>

namespace mocap {

void AddPrintedBoard(CLI::App* parent);

}  // namespace mocap
