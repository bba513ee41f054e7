#include "drivers/take/take_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "core/errors.h"
#include "drivers/quoted.h"

namespace mocap {
namespace {

constexpr std::string_view kPlainHeader = "frame,timestamp_ns";
constexpr std::string_view kHeadHeader = "frame,timestamp_ns,pan_rad,tilt_rad";

// Far beyond any recording, yet safe to add and to multiply.
constexpr std::int64_t kLatest_ns = 4'000'000'000'000'000'000;
constexpr std::uint64_t kLastFrame = 1'000'000'000'000;

/// Where in the file one is, for messages.
struct Place {
  const std::filesystem::path& file;
  int line = 1;

  [[noreturn]] void Fail(const std::string& what) const {
    throw SetupError(file.string() + ":" + std::to_string(line) + ": " + what);
  }
};

// Takes the field before the next comma off `rest`.
std::string_view NextField(std::string_view& rest) {
  const std::size_t comma = rest.find(',');
  const std::string_view field = rest.substr(0, comma);
  rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  return field;
}

template <typename Number>
Number ParseField(std::string_view& rest, const char* column, const Place& place) {
  const std::string_view field = NextField(rest);
  Number value{};
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) {
    place.Fail(std::string(column) + " is " + Quoted(field) + "; a number is wanted");
  }
  return value;
}

TakeRow ParseRow(std::string_view line, bool has_angles, const Place& place) {
  const auto commas = std::count(line.begin(), line.end(), ',');
  const int wanted = has_angles ? 4 : 2;
  if (commas + 1 != wanted) {
    place.Fail("has " + std::to_string(commas + 1) + " fields; " + std::to_string(wanted) +
               " are wanted");
  }
  TakeRow row;
  row.frame = ParseField<std::uint64_t>(line, "frame", place);
  row.timestamp_ns = ParseField<std::int64_t>(line, "timestamp_ns", place);
  if (row.frame > kLastFrame) place.Fail("frame " + std::to_string(row.frame) + " is too large");
  if (row.timestamp_ns < 0 || row.timestamp_ns > kLatest_ns) {
    place.Fail("timestamp_ns " + std::to_string(row.timestamp_ns) +
               " is no time; nanoseconds since the Unix epoch are wanted");
  }
  if (has_angles) {
    row.angles.pan_rad = ParseField<double>(line, "pan_rad", place);
    row.angles.tilt_rad = ParseField<double>(line, "tilt_rad", place);
    if (!std::isfinite(row.angles.pan_rad) || !std::isfinite(row.angles.tilt_rad)) {
      place.Fail("pan_rad and tilt_rad must be finite");
    }
  }
  return row;
}

void CheckOrder(const TakeRow& first, const TakeRow& before, const TakeRow& row,
                const Place& place) {
  if (row.frame <= before.frame) {
    place.Fail("frame " + std::to_string(row.frame) + " follows " + std::to_string(before.frame) +
               "; frame numbers must increase");
  }
  if (row.timestamp_ns <= before.timestamp_ns) {
    place.Fail("timestamp_ns " + std::to_string(row.timestamp_ns) + " follows " +
               std::to_string(before.timestamp_ns) + "; times must increase");
  }
  if (row.timestamp_ns - first.timestamp_ns > kLongestTake_ns) {
    place.Fail("timestamp_ns " + std::to_string(row.timestamp_ns) +
               " is more than a week after the first; a shorter take is wanted");
  }
}

// Gives the next whole line, without its end.
bool NextLine(std::istream& in, std::string& line) {
  if (!std::getline(in, line) || in.eof()) return false;
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

bool IsHeader(const std::string& line) { return line == kPlainHeader || line == kHeadHeader; }

}  // namespace

TakeTable ReadTakeTable(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file) || !in) {
    throw SetupError(file.string() + ": is missing; each frame's capture time is wanted");
  }
  Place place{file};
  std::string line;
  const bool any = NextLine(in, line);
  if (!any || !IsHeader(line)) {
    place.Fail("the header \"" + std::string(kPlainHeader) + "[,pan_rad,tilt_rad]\" is wanted");
  }
  TakeTable table;
  table.has_angles = line == kHeadHeader;
  while (NextLine(in, line)) {
    ++place.line;
    const TakeRow row = ParseRow(line, table.has_angles, place);
    if (!table.rows.empty()) CheckOrder(table.rows.front(), table.rows.back(), row, place);
    table.rows.push_back(row);
  }
  if (table.rows.empty()) place.Fail("no rows follow; one for each recorded frame is wanted");
  return table;
}

bool HoldsNoRows(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line;
  return NextLine(in, line) && IsHeader(line) && !NextLine(in, line);
}

}  // namespace mocap
