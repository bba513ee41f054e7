// camN.csv of a take: when each recorded frame was captured, and where the head pointed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// More than any take lasts; keeps sums of times far from their limits.
inline constexpr std::int64_t kLongestTake_ns = std::int64_t{7} * 24 * 3600 * 1'000'000'000;

/// One recorded frame.
struct TakeRow {
  std::uint64_t frame = 0;  ///< As the camera counted; a gap is a frame that it missed.
  std::int64_t timestamp_ns = 0;
  PanTiltAngles angles;
};

/// All recorded frames of a camera, in file order.
struct TakeTable {
  bool has_angles = false;
  bool is_cut_off = false;  ///< Half a row follows those that are here.
  std::vector<TakeRow> rows;
};

/// Reads a table with the header `frame,timestamp_ns` or `frame,timestamp_ns,pan_rad,tilt_rad`.
///
/// A last line that does not end and does not fit in is what a power failure left of a row: it is
/// passed over, and is_cut_off tells so.
/// @throws SetupError  naming file and line: no header, no rows, a word for a number, frames or
/// times that do not increase.
TakeTable ReadTakeTable(const std::filesystem::path& file);

/// Tells whether a table is whole but for its rows: the camera delivered nothing while the others
/// were recorded. False for what is no table.
bool HoldsNoRows(const std::filesystem::path& file);

/// The median of the times between rows; 0 where there is one row.
std::int64_t UsualIntervalNs(const TakeTable& table);

}  // namespace mocap
