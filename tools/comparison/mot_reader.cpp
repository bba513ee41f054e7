#include <algorithm>
#include <array>

#include "core/degrees.h"
#include "drivers/printable_text.h"
#include "tools/comparison/text_cells.h"
#include "tools/comparison/text_motion.h"

namespace mocap {
namespace {

constexpr const char* kMotWanted = "OpenSim's joint angles";
constexpr std::size_t kMostMotColumns = 10'000;

bool ReadIsInDegrees(TextLines& lines) {
  bool in_degrees = true;
  std::string_view line;
  for (int i = 0; i < 1000 && lines.Next(line); ++i) {
    const std::string_view text = Trimmed(line);
    if (text == "endheader") return in_degrees;
    if (text.starts_with("inDegrees")) in_degrees = text.find("no") == std::string_view::npos;
  }
  lines.Fail("has no line endheader; expected a motion file of OpenSim");
}

/// The coordinate of a column; empty: a speed, or the like.
std::string CoordinateOf(std::string_view column) {
  if (!column.starts_with('/')) return std::string(column);
  constexpr std::string_view kValue = "/value";
  if (!column.ends_with(kValue)) return {};
  column.remove_suffix(kValue.size());
  return std::string(column.substr(column.rfind('/') + 1));
}

struct MotColumns {
  std::vector<std::string> names;  ///< Coordinates; empty: not read.
  std::array<std::size_t, 3> pelvis{};
  bool has_pelvis = false;
};

MotColumns ReadMotColumns(TextLines& lines) {
  std::string_view line;
  while (lines.Next(line) && Trimmed(line).empty()) {
  }
  const auto words = WordsOf(line);
  if (words.size() < 2 || words.size() > kMostMotColumns || words[0] != "time")
    lines.Fail("has " + Quoted(line) + " after endheader; expected time and coordinates");
  MotColumns columns;
  for (const std::string_view word : words) columns.names.push_back(CoordinateOf(word));
  columns.has_pelvis = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("pelvis_t") + "xyz"[axis];
    const auto place = std::ranges::find(columns.names, name);
    columns.has_pelvis = columns.has_pelvis && place != columns.names.end();
    columns.pelvis[axis] = static_cast<std::size_t>(place - columns.names.begin());
  }
  return columns;
}

}  // namespace

MotionFile ReadMot(const std::filesystem::path& file) {
  TextLines lines(file, kMotWanted);
  const double factor = ReadIsInDegrees(lines) ? 1 : kDegreesPerRad;
  const MotColumns columns = ReadMotColumns(lines);
  RecordedMotion motion;
  std::vector<std::size_t> places;
  for (std::size_t i = 1; i < columns.names.size(); ++i) {
    const bool is_place =
        columns.has_pelvis && std::ranges::find(columns.pelvis, i) != columns.pelvis.end();
    if (columns.names[i].empty() || is_place) continue;
    motion.angles.push_back({columns.names[i], {}});
    places.push_back(i);
  }
  if (columns.has_pelvis) motion.points.push_back({std::string(kPelvisOrigin), {}});
  std::string_view line;
  while (lines.Next(line)) {
    const auto cells = WordsOf(line);
    if (cells.empty()) continue;
    if (cells.size() != columns.names.size()) {
      lines.Fail("has " + Counted(cells.size(), "number") + "; expected " +
                 std::to_string(columns.names.size()));
    }
    AddTime(NeededNumber(cells[0], "time", lines), motion.time_s, lines);
    for (std::size_t i = 0; i < places.size(); ++i)
      motion.angles[i].deg.push_back(factor * NumberOrNan(cells[places[i]]));
    if (!columns.has_pelvis) continue;
    const auto metres = [&](std::size_t axis) { return NumberOrNan(cells[columns.pelvis[axis]]); };
    motion.points[0].p_mm.push_back(kMmPerMetre * Vector3(metres(0), metres(1), metres(2)));
  }
  if (motion.time_s.empty()) lines.Fail("has no row; expected at least one");
  if (motion.angles.empty()) lines.Fail("has no angle; expected coordinates of OpenSim's models");
  return {"OpenSim motion", {std::move(motion)}, {}};
}

}  // namespace mocap
