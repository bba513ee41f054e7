// A log of LCM messages as a result.
#pragma once

#include <filesystem>

#include "tools/results/result.h"

namespace mocap {

/// Reads MOCAP_POSE and MOCAP_BODY, with any prefix, out of what lcm-logger recorded; the last body
/// counts.
/// @throws SetupError  when the log holds none of either or damaged ones.
Result ReadPoseLog(const std::filesystem::path& log);

}  // namespace mocap
