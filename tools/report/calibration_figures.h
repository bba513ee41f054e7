// Figures of the calibration report, as inline SVG.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle_errors.h"
#include "tools/calibration/extrinsics.h"
#include "tools/calibration/studio_check.h"

namespace mocap {

/// Draws the positions of a camera's observed corners, and their errors, enlarged.
std::string CoverageSvg(const StudioFit& fit, int camera, const std::vector<CornerError>& errors);

/// Draws the room from above: cameras with their fields of view, and how many see each place.
std::string RoomPlanSvg(const std::vector<CameraCalibration>& cameras, const SeenVolume& volume);

}  // namespace mocap
