#include <algorithm>
#include <array>
#include <map>

#include "tools/comparison/text_cells.h"
#include "tools/comparison/text_motion.h"

namespace mocap {
namespace {

constexpr const char* kCsvWanted = "a table of points";

struct CsvTime {
  std::string_view name;
  double seconds;
};
constexpr std::array kCsvTimes = {CsvTime{"time_s", 1}, CsvTime{"timestamp_ns", 1e-9},
                                  CsvTime{"utime_us", 1e-6}};

struct CsvColumns {
  std::size_t count = 0, time = 0;
  double seconds = 1;
  std::vector<std::pair<std::string, std::array<std::size_t, 3>>> points;
  std::vector<std::pair<std::string, std::size_t>> angles;
};

CsvColumns ReadCsvColumns(TextLines& lines) {
  std::string_view header;
  if (!lines.Next(header)) lines.Fail("is empty; expected a header");
  std::vector<std::string> names;
  for (const std::string_view cell : CellsOf(header, ',')) names.emplace_back(cell);
  std::map<std::string, std::size_t> place;
  // poses.csv has the torso's frame and then its point by the same names: the later ones count.
  for (std::size_t i = 0; i < names.size(); ++i) place[names[i]] = i;
  CsvColumns columns;
  columns.count = names.size();
  const auto time = std::ranges::find_if(
      kCsvTimes, [&](const CsvTime& t) { return place.contains(std::string(t.name)); });
  if (time == kCsvTimes.end())
    lines.Fail("has no column of times; expected time_s, timestamp_ns or utime_us, and commas");
  columns.time = place[std::string(time->name)];
  columns.seconds = time->seconds;
  constexpr std::string_view kX = "_x_mm", kDeg = "_deg";
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (name.ends_with(kDeg)) columns.angles.emplace_back(name.substr(0, name.size() - 4), i);
    if (!name.ends_with(kX) || place[name] != i) continue;
    const std::string point = name.substr(0, name.size() - kX.size());
    const auto y = place.find(point + "_y_mm"), z = place.find(point + "_z_mm");
    if (y == place.end() || z == place.end() || point == "torso_origin") continue;
    columns.points.push_back({point, {i, y->second, z->second}});
  }
  if (columns.points.empty() && columns.angles.empty())
    lines.Fail("has no points and no angles; expected columns such as knee_l_x_mm");
  return columns;
}

}  // namespace

MotionFile ReadCsvMotion(const std::filesystem::path& file) {
  TextLines lines(file, kCsvWanted);
  const CsvColumns columns = ReadCsvColumns(lines);
  RecordedMotion motion;
  for (const auto& [name, place] : columns.points) motion.points.push_back({name, {}});
  for (const auto& [name, place] : columns.angles) motion.angles.push_back({name, {}});
  double first = 0;
  std::string_view line;
  while (lines.Next(line)) {
    if (Trimmed(line).empty()) continue;
    const auto cells = CellsOf(line, ',');
    if (cells.size() != columns.count) {
      lines.Fail("has " + std::to_string(cells.size()) + " cells; expected " +
                 std::to_string(columns.count) + " as in the header");
    }
    const double time = NeededNumber(cells[columns.time], "time", lines);
    if (motion.time_s.empty()) first = time;
    AddTime(columns.seconds * (time - first), motion.time_s, lines);
    for (std::size_t i = 0; i < columns.points.size(); ++i) {
      const auto& at = columns.points[i].second;
      motion.points[i].p_mm.emplace_back(NumberOrNan(cells[at[0]]), NumberOrNan(cells[at[1]]),
                                         NumberOrNan(cells[at[2]]));
    }
    for (std::size_t i = 0; i < columns.angles.size(); ++i)
      motion.angles[i].deg.push_back(NumberOrNan(cells[columns.angles[i].second]));
  }
  if (motion.time_s.empty()) lines.Fail("has no row; expected at least one");
  return {"CSV", {std::move(motion)}, {}};
}

}  // namespace mocap
