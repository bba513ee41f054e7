// Whether all is good, and what helps where it is not.
#pragma once

#include <string>
#include <vector>

#include "daemon/status/service_report.h"

namespace mocap {

/// Says what is not as it should be and what helps, the worst first; empty when all is good.
/// docs/operating.md has a line on each.
std::vector<std::string> Diagnostics(const ServiceReport& report);

/// "5 s", "12 min", "3 h", "9 days".
std::string Duration(std::int64_t ns);

}  // namespace mocap
