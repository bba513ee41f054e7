// The checks of `mocap doctor`, one function each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"

namespace mocap {

enum class Verdict {
  kGood,
  kAdvice,  ///< It works, but could work better.
  kBad
};

/// Result of one check.
struct Diagnosis {
  Verdict verdict = Verdict::kGood;
  std::string what;  ///< The finding.
  std::string fix;   ///< What to type or change; empty if good.
};

/// Whose limits apply to the daemon.
enum class Starter { kSystemd, kCaller };

Diagnosis CheckMulticastRoute();
/// Sends a message to the configured address and expects to receive it.
Diagnosis CheckMulticastEcho(const std::string& url);
Diagnosis CheckSocketBuffers();
Diagnosis CheckLimits(const RealtimeConfig& config, Starter starter);
Diagnosis CheckClock();
Diagnosis CheckProcessor();
/// Checks free space and, where permitted, how fast the disk writes 64 MB.
/// @param bytes_per_second  needed by a recording.
Diagnosis CheckDisk(const std::filesystem::path& folder, double bytes_per_second);
/// One diagnosis for each device of a live studio, and for the load of its bus.
std::vector<Diagnosis> CheckDevices(const Config& config);
/// One diagnosis for each implausible place of a camera in the calibration, or that all are good;
/// none without a calibration.
std::vector<Diagnosis> CheckCalibration(const Config& config);
Diagnosis CheckControl(const std::filesystem::path& socket);
/// Checks, for a studio with nodes, whether each of them answers.
std::vector<Diagnosis> CheckNodes(const Config& config);

}  // namespace mocap
