// Faults of a studio's camera nodes and of their connection, and their remedies.
#pragma once

#include <string>
#include <vector>

#include "daemon/pipeline/camera_status.h"
#include "daemon/recording/recording.h"
#include "daemon/status/node_report.h"
#include "daemon/status/studio_link.h"

namespace mocap {

/// As Diagnostics(). @param lcm_url  the address at which nodes are heard.
std::vector<std::string> NodeDiagnostics(const NodesReport& report, const std::string& lcm_url);

/// The same of a node's connection to its studio. @param recording  at the node.
std::vector<std::string> LinkDiagnostics(const StudioLink& link,
                                         const std::vector<CameraStatus>& cameras,
                                         const RecordingStatus& recording,
                                         const std::string& lcm_url);

/// Whether this node cannot be heard, or its times cannot be used. Its cameras are then reported
/// with it.
bool IsOfLostNode(const NodesReport& report, const std::string& node);

}  // namespace mocap
