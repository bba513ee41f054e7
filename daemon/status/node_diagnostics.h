// What is wrong with the camera nodes of a studio, and what helps.
#pragma once

#include <string>
#include <vector>

#include "daemon/status/node_report.h"

namespace mocap {

/// As Diagnostics() has it. @param lcm_url  by which nodes are heard.
std::vector<std::string> NodeDiagnostics(const NodesReport& report, const std::string& lcm_url);

/// Whether a node of that name cannot be heard, or its times cannot be used: its cameras are told
/// with it.
bool IsOfLostNode(const NodesReport& report, const std::string& node);

}  // namespace mocap
