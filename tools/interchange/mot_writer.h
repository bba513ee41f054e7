// OpenSim's motion files.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes joint angles in degrees under the names of Rajagopal's model, and the pelvis' place in
/// metres. Frames in which nobody is tracked have no row: a gap is a jump of the time.
/// @pre  the scene has one subject.
/// @throws SetupError  when no frame is tracked.
ExportRemarks WriteMot(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
