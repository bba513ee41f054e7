// OpenSim's motion files.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes joint angles in degrees with the names of Rajagopal's model, and the pelvis position in
/// metres. Frames without tracking have no row, so a gap is a jump in time.
/// @pre  the scene has one subject.
/// @throws SetupError  when no frame is tracked.
ExportRemarks WriteMot(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
