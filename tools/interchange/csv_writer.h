// Writes a result as a table for spreadsheets and scripts.
#pragma once

#include <string>
#include <vector>

#include "tools/interchange/export_format.h"

namespace mocap {

/// Names of the columns, each of them once: times and state; the pose as in poses.csv, with the
/// origin of the torso's frame as torso_origin; joint angles in degrees by the names of
/// kCoordinateNames; every joint of the body in radians; deviations; probability.
std::vector<std::string> CsvColumns(const BodyRecord& body);

/// Writes one row per frame: time_s since the scene's first moment, utime_us since the epoch, then
/// the pose in the world frame. Cells of unknown values are empty.
/// @pre  the scene has one subject.
ExportRemarks WriteCsv(const ExportScene& scene, std::ostream& out);

}  // namespace mocap
