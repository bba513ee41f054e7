// The columns of poses.csv.
#pragma once

#include <string>
#include <vector>

namespace mocap {

/// frame, timestamp_ns and state before the pose; voxels after it.
inline constexpr std::size_t kColumnsBesidePose = 4;

/// Names of all columns, in order.
std::vector<std::string> ResultColumns();

}  // namespace mocap
