// A result as OpenSim's marker table.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes the 23 points as markers in millimetres, y up (see YUpFromWorld), joint centres under
/// their usual names, as LHJC; several people stand
/// beside each other. Cells of somebody who is not tracked in a frame are "nan", which OpenSim
/// reads as missing.
ExportRemarks WriteTrc(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
