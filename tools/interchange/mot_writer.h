// OpenSim's motion files.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes all coordinates of Rajagopal's model by their names: joint angles in degrees, and the
/// pelvis position in metres. Those that the result does not show are 0; where a single frame does
/// not show them, the last value is held. Both are remarked on. Frames without tracking have no
/// row, so a gap is a jump in time.
/// @pre  the scene has one subject.
/// @throws SetupError  when no frame is tracked.
ExportRemarks WriteMot(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
