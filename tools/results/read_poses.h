// Reads poses.csv.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/results/result.h"

namespace mocap {

inline constexpr const char* kResultWanted = "what mocap track writes";

/// Reads the rows of a result. Columns after voxels are found by their names; others are skipped.
/// @param body  of the result. If no column follows voxels, joints beyond the paper's sixteen are
/// removed from it.
/// @param remarks  gets what is worth telling about the file, one line each.
/// @throws SetupError  naming file and line, and a joint's column that is missing.
std::vector<PoseRow> ReadPoses(const std::filesystem::path& file, BodyRecord& body,
                               std::vector<std::string>& remarks);

}  // namespace mocap
