// Faults of single cameras, and their remedies.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/status/service_report.h"

namespace mocap {

/// As Diagnostics(): lost, silent and slow cameras, and pictures unlike their background. Cameras
/// with the same fault share a line, as one cause is likely.
std::vector<std::string> CameraDiagnostics(const ServiceReport& report);

/// Says in one line what cameras do: "cam1 is", "cam1, cam2 are", "all 6 cameras are".
/// @param names  at least one.  @param all  how many cameras there are.
std::string CamerasDo(const std::vector<std::string>& names, std::size_t all,
                      std::string_view one_does, std::string_view several_do);

/// Whether a camera is silent with the one that triggers it, which is reported.
bool WaitsForTrigger(const ServiceReport& report, std::size_t camera);

/// Whether a camera delivers about as many frames as expected.
bool HasGoodRate(const ServiceReport& report, std::size_t camera);

}  // namespace mocap
