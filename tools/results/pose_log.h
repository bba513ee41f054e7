// A log of LCM messages as a result.
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

/// What pose_t would say of one of several people.
pose_t PoseOf(const people_t& set, const person_t& person);
/// Nanoseconds of a message's microseconds; empty where they are no time of day.
std::optional<std::int64_t> CaptureNsOf(std::int64_t utime);
/// What a message says of a pose; empty where a number is none.
std::optional<PoseRow> PoseRowOf(const pose_t& message);
/// What it says of a body, likewise.
std::optional<BodyRecord> BodyRecordOf(const body_t& message);

/// Reads MOCAP_POSE and MOCAP_BODY out of what lcm-logger recorded; the last body counts. What is
/// damaged or of somebody else is passed over, and the result's remarks tell.
/// @param prefix  before the channels' names. Empty: whatever it is, if it is one.
/// @throws SetupError  when the log holds none of either, or those of several daemons.
Result ReadPoseLog(const std::filesystem::path& log, const std::optional<std::string>& prefix);

}  // namespace mocap
