#include "drivers/take/take_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "drivers/take/text_table.h"

namespace mocap {
namespace {

constexpr const char* kWanted = "a table of capture times";
const std::array<std::string, 2> kHeaders = {"frame,timestamp_ns",
                                             "frame,timestamp_ns,pan_rad,tilt_rad"};
const std::array<std::string, 4> kColumns = {"frame", "timestamp_ns", "pan_rad", "tilt_rad"};

// Far beyond any recording, but without overflow in sums and products.
constexpr std::int64_t kLatest_ns = 4'000'000'000'000'000'000;
constexpr std::uint64_t kLastFrame = 1'000'000'000'000;
constexpr double kStill_rad = 0.01;

std::size_t RequireTakeHeader(TextLines& lines) {
  return RequireHeader(lines, kHeaders, "\"frame,timestamp_ns[,pan_rad,tilt_rad]\"");
}

TakeRow ParseRow(std::string_view line, bool has_angles, const TextLines& lines) {
  const TableRow cells(line, std::span(kColumns).first(has_angles ? 4 : 2), lines);
  TakeRow row;
  row.frame = cells.Number<std::uint64_t>(0);
  row.timestamp_ns = cells.Number<std::int64_t>(1);
  if (row.frame > kLastFrame) lines.Fail("frame " + std::to_string(row.frame) + " is too large");
  if (row.timestamp_ns < 0 || row.timestamp_ns > kLatest_ns) {
    lines.Fail("timestamp_ns " + std::to_string(row.timestamp_ns) +
               " is not a time; expected nanoseconds since the Unix epoch");
  }
  if (has_angles) row.angles = {cells.Number<double>(2), cells.Number<double>(3)};
  return row;
}

bool IsRow(std::string_view line, bool has_angles, const TextLines& lines) {
  try {
    ParseRow(line, has_angles, lines);
  } catch (const SetupError&) {
    return false;
  }
  return true;
}

void CheckOrder(const TakeRow& first, const TakeRow& before, const TakeRow& row,
                const TextLines& lines) {
  if (row.frame <= before.frame) {
    lines.Fail("frame " + std::to_string(row.frame) + " follows " + std::to_string(before.frame) +
               "; frame numbers must increase");
  }
  if (row.timestamp_ns <= before.timestamp_ns) {
    lines.Fail("timestamp_ns " + std::to_string(row.timestamp_ns) + " follows " +
               std::to_string(before.timestamp_ns) +
               "; expected times in nanoseconds that increase");
  }
  if (row.timestamp_ns - first.timestamp_ns > kLongestTake_ns) {
    lines.Fail("timestamp_ns " + std::to_string(row.timestamp_ns) +
               " is more than a week after the first; expected a shorter take");
  }
}

// A row without a line end is whole, as some editors leave it, or cut off. A number without its
// last digits is less than its predecessor, or far behind it if that was small.
bool IsPlausible(const std::vector<TakeRow>& rows, const TakeRow& row) {
  if (rows.size() < 2) return true;
  const auto turn = [](const TakeRow& from, const TakeRow& to) {
    return std::hypot(to.angles.pan_rad - from.angles.pan_rad,
                      to.angles.tilt_rad - from.angles.tilt_rad);
  };
  double most_rad = kStill_rad;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    most_rad = std::max(most_rad, turn(rows[i - 1], rows[i]));
  }
  const std::int64_t usual_ns = (rows.back().timestamp_ns - rows.front().timestamp_ns) /
                                static_cast<std::int64_t>(rows.size() - 1);
  return row.timestamp_ns - rows.back().timestamp_ns > usual_ns / 4 &&
         turn(rows.back(), row) < 2 * most_rad;
}

}  // namespace

TakeTable ReadTakeTable(const std::filesystem::path& file) {
  TextLines lines(file, kWanted);
  TakeTable table;
  table.has_angles = RequireTakeHeader(lines) == 1;
  if (!lines.has_end()) lines.Fail("ends with its header; expected a row for each frame");
  std::string_view line;
  while (lines.NextRow(line)) {
    try {
      const TakeRow row = ParseRow(line, table.has_angles, lines);
      if (!table.rows.empty()) CheckOrder(table.rows.front(), table.rows.back(), row, lines);
      table.is_cut_off = !lines.has_end() && !IsPlausible(table.rows, row);
      if (!table.is_cut_off) table.rows.push_back(row);
    } catch (const SetupError&) {
      if (lines.has_end()) throw;
      table.is_cut_off = true;
    }
  }
  if (table.rows.empty()) lines.Fail("has no rows; expected one for each recorded frame");
  return table;
}

bool HoldsNoRows(const std::filesystem::path& file) {
  try {
    TextLines lines(file, kWanted);
    const bool has_angles = RequireTakeHeader(lines) == 1;
    std::string_view line;
    if (!lines.has_end()) return false;
    if (!lines.NextRow(line)) return true;
    if (lines.has_end()) return false;
    return !IsRow(line, has_angles, lines);
  } catch (const SetupError&) {
    return false;
  }
}

std::int64_t UsualIntervalNs(const TakeTable& table) {
  std::vector<std::int64_t> intervals_ns;
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    intervals_ns.push_back(table.rows[i].timestamp_ns - table.rows[i - 1].timestamp_ns);
  }
  if (intervals_ns.empty()) return 0;
  const auto middle = intervals_ns.begin() + static_cast<std::ptrdiff_t>(intervals_ns.size() / 2);
  std::nth_element(intervals_ns.begin(), middle, intervals_ns.end());
  return *middle;
}

}  // namespace mocap
