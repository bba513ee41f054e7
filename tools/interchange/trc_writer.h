// Writes a result as OpenSim's marker table.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes the 23 points, heels, toes, ankles and wrists as markers in millimetres, y up (see
/// YUpFromWorld). Joint centres have their usual names, such as LHJC. Several people are side by
/// side. Cells of people who are not tracked in a frame, and of points that a result does not have,
/// are "nan", which OpenSim reads as missing.
ExportRemarks WriteTrc(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
