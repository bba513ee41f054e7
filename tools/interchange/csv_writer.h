// Writes a result as a table for spreadsheets and scripts.
#pragma once

#include "tools/interchange/export_format.h"

namespace mocap {

/// Writes one row per frame: time_s since the scene's first moment, utime_us since the epoch,
/// state, the paper's 23 numbers and the 23 points in the world frame. Cells of unknown values are
/// empty.
/// @pre  the scene has one subject.
ExportRemarks WriteCsv(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
