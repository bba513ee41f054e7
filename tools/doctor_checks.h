// The checks of `mocap doctor`, one function each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config.h"

namespace mocap {

enum class Grade {
  kGood,
  kAdvice,  ///< It works, but could work better.
  kBad
};

/// Result of one check.
struct Diagnosis {
  Grade grade = Grade::kGood;
  std::string what;  ///< The finding.
  std::string fix;   ///< What to type or change; empty if good.
};

/// Whose limits apply to the daemon.
enum class Starter { kSystemd, kCaller };

/// Sends a message to the configured address and expects to receive it.
Diagnosis CheckMessages(const std::string& url);
Diagnosis CheckSocketBuffers();
Diagnosis CheckLimits(const RealtimeConfig& config, Starter starter);
Diagnosis CheckClock();
Diagnosis CheckProcessor();
/// Checks free space and, where permitted, how fast the disk writes 64 MB.
/// @param keep_free_mb  that recordings leave free.
Diagnosis CheckDisk(const std::filesystem::path& folder, double keep_free_mb);
/// Judges the room for takes on a disk, for the recording of usual cameras.
/// @param disk  the folder, and what else is known of it, for the message.
Diagnosis JudgeSpace(const std::string& disk, double free_mb, double keep_free_mb,
                     std::optional<double> speed_mb);
/// One diagnosis for each device of a live studio, and for the load of its bus.
std::vector<Diagnosis> CheckDevices(const Config& config);
/// One diagnosis for each implausible place of a camera in the calibration, or that all are good;
/// none without a calibration.
std::vector<Diagnosis> CheckCalibration(const Config& config);
Diagnosis CheckControl(const std::filesystem::path& socket, Starter starter);
/// Checks, for a studio with nodes, whether each of them answers.
std::vector<Diagnosis> CheckNodes(const Config& config);

}  // namespace mocap
