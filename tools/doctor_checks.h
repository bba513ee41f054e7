// The checks of `mocap doctor`, one function each.
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
struct Diagnosis {
  Verdict verdict = Verdict::kGood;
  std::string what;  ///< What was found.
  std::string fix;   ///< What to type or change; empty when it is good.
};

/// Whose limits hold for the daemon.
enum class Starter { kSystemd, kCaller };

Diagnosis CheckMulticastRoute();
/// Sends a message to itself by the configured address.
Diagnosis CheckMulticastEcho(const std::string& url);
Diagnosis CheckSocketBuffers();
Diagnosis CheckLimits(const RealtimeConfig& config, Starter starter);
Diagnosis CheckClock();
Diagnosis CheckProcessor();
/// Looks at space, and how fast the disk takes 64 MB where that is allowed.
/// @param bytes_per_second  what a recording needs.
Diagnosis CheckDisk(const std::filesystem::path& folder, double bytes_per_second);
/// One diagnosis for each device of a live studio, and what its bus needs.
std::vector<Diagnosis> CheckDevices(const Config& config);
Diagnosis CheckControl(const std::filesystem::path& socket);
/// Of a studio, whether each of its nodes answers.
std::vector<Diagnosis> CheckNodes(const Config& config);

}  // namespace mocap
