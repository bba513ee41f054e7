// The report of `mocap calibrate`: one HTML file that needs nothing beside it.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/extrinsics.h"
#include "tools/calibration/studio_check.h"

namespace mocap {

/// Writes the page: verdict, errors in pixels and millimetres, coverage, plan, seen volume, worst
/// views.
std::string CalibrationReportHtml(const std::string& title, const StudioFit& fit,
                                  const std::vector<Finding>& findings);

}  // namespace mocap
