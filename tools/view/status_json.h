// Status of the service, for the page.
#pragma once

#include <string>

#include "daemon/status/service_report.h"

namespace mocap {

/// The status as `mocap status --json` has it. What is not known of a camera is null. `poor` lists
/// what is not good, for the service and for each camera.
std::string StatusJson(const ServiceReport& report);

}  // namespace mocap
