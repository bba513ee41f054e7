// Faults of a studio's camera nodes, and their remedies.
#pragma once

#include <string>
#include <vector>

#include "daemon/status/node_report.h"

namespace mocap {

/// As Diagnostics(). @param lcm_url  the address at which nodes are heard.
std::vector<std::string> NodeDiagnostics(const NodesReport& report, const std::string& lcm_url);

/// Whether this node cannot be heard, or its times cannot be used. Its cameras are then reported
/// with it.
bool IsOfLostNode(const NodesReport& report, const std::string& node);

}  // namespace mocap
