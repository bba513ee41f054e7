// Pictures of the calibration's report, as inline SVG.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle_errors.h"
#include "tools/calibration/extrinsics.h"
#include "tools/calibration/studio_check.h"

namespace mocap {

/// Draws where a camera saw corners, and their errors much enlarged.
std::string CoverageSvg(const StudioFit& fit, int camera, const std::vector<CornerError>& errors);

/// Draws the room from above: cameras with what they look at, and how many see each place.
std::string RoomPlanSvg(const std::vector<CameraCalibration>& cameras, const SeenVolume& volume);

}  // namespace mocap
