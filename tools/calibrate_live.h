// Guides whoever shows a board to live cameras.
#pragma once

#include <string>
#include <vector>

#include "tools/calibrate_steps.h"
#include "tools/calibration/board_hints.h"

namespace mocap {

/// Records the footage, and the floor's where one is asked for, from the cameras of the
/// configuration; says what to do next, and on a terminal what is still missing. The Enter key ends
/// a step; the first ends by itself, too, when nothing is missing.
/// @throws SetupError, std::runtime_error  as RecordBoard.
void RecordFootage(const CalibrateArguments& arguments);

/// A line a camera: views, coverage, and what is missing.
std::string HintText(const std::vector<CameraHint>& hints);

}  // namespace mocap
