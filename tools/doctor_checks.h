// What `mocap doctor` looks at, one function each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"

namespace mocap {

enum class Verdict {
  kGood,
  kAdvice,  ///< It works, but not as well as it could.
  kBad
};

/// One thing that was looked at.
struct Finding {
  Verdict verdict = Verdict::kGood;
  std::string what;  ///< What was found.
  std::string fix;   ///< What to type or change; empty when it is good.
};

Finding CheckMulticastRoute();
/// Sends a message to itself by the configured address.
Finding CheckMulticastEcho(const std::string& url);
Finding CheckSocketBuffers();
Finding CheckLimits(const RealtimeConfig& config);
Finding CheckClock();
Finding CheckProcessor();
/// Looks at space, and how fast the disk takes 64 MB where that is allowed.
/// @param bytes_per_second  what a recording needs.
Finding CheckDisk(const std::filesystem::path& folder, double bytes_per_second);
/// One finding for each device of a live studio, and what its bus needs.
std::vector<Finding> CheckDevices(const Config& config);
Finding CheckControl(const std::filesystem::path& socket);

}  // namespace mocap
