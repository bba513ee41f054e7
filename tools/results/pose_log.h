// Reads a log of LCM messages as a result.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mocap/body_t.hpp>
#include <mocap/people_t.hpp>
#include <mocap/pose_t.hpp>
#include <optional>
#include <string>

#include "tools/results/result.h"

namespace mocap {

/// Converts one of several people to a pose_t.
pose_t PoseOf(const people_t& set, const person_t& person);
/// Converts a message's microseconds to nanoseconds; empty if they are no valid time of day.
std::optional<std::int64_t> CaptureNsOf(std::int64_t utime);
/// Converts a message to a row; empty if a number is invalid.
std::optional<PoseRow> PoseRowOf(const pose_t& message);
/// Converts a message to a body; empty if a number is invalid.
std::optional<BodyRecord> BodyRecordOf(const body_t& message);
/// Removes joint angles that were measured for another body: they have no names in this one.
void KeepNamedJoints(Result& result);

/// Reads MOCAP_POSE, MOCAP_BODY and MOCAP_DETAILS from a log of lcm-logger; the last body counts.
/// Messages that are damaged or from other senders are skipped; the result's remarks report this.
/// @param prefix  of the channels' names. Empty: any, if there is only one.
/// @throws SetupError  when the log has none of either, or those of several daemons.
Result ReadPoseLog(const std::filesystem::path& log, const std::optional<std::string>& prefix);

}  // namespace mocap
