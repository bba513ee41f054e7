// Figures of the calibration report.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle_errors.h"
#include "tools/calibration/extrinsics.h"
#include "tools/calibration/studio_check.h"
#include "tools/report/report_page.h"

namespace mocap {

/// The positions of a camera's observed corners, and their errors, enlarged.
/// @param hint  what is still missing; may be empty.
Json CoverageFigure(const StudioFit& fit, int camera, const std::vector<CornerError>& errors,
                    const std::string& hint);

/// The room from above: cameras with their fields of view, and how many see each place.
Json RoomPlan(const std::vector<CameraCalibration>& cameras, const SeenVolume& volume);

}  // namespace mocap
