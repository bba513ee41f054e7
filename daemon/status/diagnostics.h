// Whether all is good, and otherwise what helps.
#pragma once

#include <string>
#include <vector>

#include "daemon/status/service_report.h"

namespace mocap {

/// The stance of a person cannot explain a larger silhouette shift.
inline constexpr double kMostShift_px = 2;
/// A sender of keypoints that agrees less with the poses is reported.
inline constexpr double kLeastAgreement = 0.5;

/// Lists faults and their remedies, the worst first; empty if all is good. docs/operating.md
/// explains each line.
std::vector<std::string> Diagnostics(const ServiceReport& report);

/// "5 s", "12 min", "3 h", "9 days".
std::string Duration(std::int64_t ns);

}  // namespace mocap
