// camN.csv of a take: capture times of the frames and angles of the head.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Longer than any take; keeps sums of times from overflowing.
inline constexpr std::int64_t kLongestTake_ns = std::int64_t{7} * 24 * 3600 * 1'000'000'000;

/// One recorded frame.
struct TakeRow {
  std::uint64_t frame = 0;  ///< The camera's count; a gap means dropped frames.
  std::int64_t timestamp_ns = 0;
  PanTiltAngles angles;
};

/// All recorded frames of a camera, in file order.
struct TakeTable {
  bool has_angles = false;
  bool is_cut_off = false;  ///< The file ends with part of a row.
  std::vector<TakeRow> rows;
};

/// Reads a table with the header `frame,timestamp_ns` or `frame,timestamp_ns,pan_rad,tilt_rad`.
///
/// An implausible last line without a line end is the rest of a row after a power failure. It is
/// ignored and sets is_cut_off.
/// @throws SetupError  naming file and line: no header, no rows, text instead of a number, frames
/// or times that do not increase.
TakeTable ReadTakeTable(const std::filesystem::path& file);

/// Whether a table is valid but has no rows: the camera delivered nothing during the recording.
/// False if it is not a table.
bool HoldsNoRows(const std::filesystem::path& file);

/// Returns the median interval between rows; 0 if there is only one row.
std::int64_t UsualIntervalNs(const TakeTable& table);

}  // namespace mocap
