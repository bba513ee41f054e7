// Guides the person who shows a board to live cameras.
#pragma once

#include <string>
#include <vector>

#include "tools/calibrate_steps.h"
#include "tools/calibration/board_hints.h"

namespace mocap {

/// Records the footage, and the floor's if requested, with the cameras of the configuration. Prints
/// what to do next and, on a terminal, what is still missing. The Enter key ends a step. The first
/// step also ends when nothing is missing.
void RecordFootage(const CalibrateArguments& arguments);

/// One line per camera: views, coverage, and what is missing.
std::string HintText(const std::vector<CameraHint>& hints);

}  // namespace mocap
