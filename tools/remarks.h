// Remarks of a command about its input.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// Prints remarks, one line each, to standard error.
/// @param command  "track".
void TellRemarks(const std::string& command, const std::vector<std::string>& remarks);

}  // namespace mocap
