// The report of `mocap calibrate`: one self-contained HTML file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/calibration/extrinsics.h"
#include "tools/calibration/studio_check.h"

namespace mocap {

/// Writes the page: result, errors in pixels and millimetres, coverage, plan, visible volume, worst
/// views. @param made_s  time since the Unix epoch.
std::string CalibrationReportHtml(const std::string& title, std::int64_t made_s,
                                  const StudioFit& fit, const std::vector<Finding>& findings);

}  // namespace mocap
