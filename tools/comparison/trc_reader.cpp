#include <algorithm>

#include "core/errors.h"
#include "drivers/printable_text.h"
#include "tools/comparison/text_cells.h"
#include "tools/comparison/text_motion.h"

namespace mocap {
namespace {

constexpr const char* kTrcWanted = "OpenSim's markers";
constexpr std::size_t kMostTrcMarkers = 10'000;

/// Unit of the header's names and values [mm].
double TrcUnit(std::string_view names, std::string_view values, const TextLines& lines) {
  const auto keys = WordsOf(names), cells = WordsOf(values);
  const auto key = std::ranges::find(keys, "Units");
  const auto i = static_cast<std::size_t>(key - keys.begin());
  if (key == keys.end() || i >= cells.size()) lines.Fail("has no Units; expected mm or m");
  const std::optional<double> unit = UnitInMm(cells[i]);
  if (!unit) lines.Fail("has the unit " + Quoted(cells[i]) + "; expected mm or m");
  return *unit;
}

/// The markers' names: the cells after those of frame and time. Each has two empty ones behind it.
std::vector<PointTrack> TrcMarkers(std::string_view line, const TextLines& lines) {
  std::vector<PointTrack> markers;
  const bool has_tabs = line.find('\t') != std::string_view::npos;
  const auto cells = has_tabs ? CellsOf(line, '\t') : WordsOf(line);
  if (cells.empty() || !cells[0].starts_with("Frame"))
    lines.Fail("begins with " + Quoted(line) + "; expected Frame#, Time and names of markers");
  for (std::size_t i = 2; i < cells.size(); ++i)
    if (!cells[i].empty()) markers.push_back({std::string(cells[i]), {}});
  if (markers.empty() || markers.size() > kMostTrcMarkers)
    lines.Fail("names " + Counted(markers.size(), "marker") + "; expected 1 to 10000");
  return markers;
}

void ReadTrcRow(std::string_view line, double unit_mm, RecordedMotion& motion,
                const TextLines& lines) {
  const bool has_tabs = line.find('\t') != std::string_view::npos;
  const auto cells = has_tabs ? CellsOf(line, '\t') : WordsOf(line);
  if (cells.size() < 2) lines.Fail("has no time; expected frame, time and places");
  AddTime(NeededNumber(cells[1], "time", lines), motion.time_s, lines);
  const auto number = [&](std::size_t i) {
    return i < cells.size() ? NumberOrNan(cells[i]) : kUnmeasured;
  };
  for (std::size_t m = 0; m < motion.points.size(); ++m) {
    const std::size_t at = 2 + 3 * m;
    motion.points[m].p_mm.push_back(unit_mm * Vector3(number(at), number(at + 1), number(at + 2)));
  }
}

}  // namespace

MotionFile ReadTrc(const std::filesystem::path& file) {
  TextLines lines(file, kTrcWanted);
  std::string_view line;
  if (!lines.Next(line) || !line.starts_with("PathFileType"))
    lines.Fail("does not begin with PathFileType; expected a TRC file");
  std::string names, values;
  for (std::string* text : {&names, &values}) {
    if (!lines.Next(line)) lines.Fail("ends in its header");
    *text = line;
  }
  const double unit_mm = TrcUnit(names, values, lines);
  RecordedMotion all;
  if (!lines.Next(line)) lines.Fail("ends in its header");
  all.points = TrcMarkers(line, lines);
  while (lines.Next(line)) {
    const std::string_view row = Trimmed(line);
    // The line of X1, Y1, Z1, and empty ones.
    if (row.empty() || row[0] == 'X') continue;
    ReadTrcRow(line, unit_mm, all, lines);
  }
  if (all.time_s.empty()) lines.Fail("has no frame; expected at least one");
  return {"TRC", BySubject(std::move(all), Printable(file.string())), {}};
}

std::vector<RecordedMotion> BySubject(RecordedMotion all, const std::string& file) {
  const auto subject_of = [](const std::string& name) {
    const std::size_t colon = name.rfind(':');
    return colon == std::string::npos ? std::string() : name.substr(0, colon);
  };
  std::vector<RecordedMotion> subjects;
  const auto subject = [&](const std::string& name) -> RecordedMotion& {
    const auto found = std::ranges::find(subjects, name, &RecordedMotion::subject);
    if (found != subjects.end()) return *found;
    RecordedMotion& added = subjects.emplace_back();
    added.subject = name;
    added.time_s = all.time_s;
    added.has_unit = all.has_unit;
    return added;
  };
  const auto without_prefix = [](std::string& name) { name.erase(0, name.rfind(':') + 1); };
  constexpr std::size_t kMostSubjects = 100;
  for (PointTrack& track : all.points) {
    RecordedMotion& owner = subject(subject_of(track.name));
    if (subjects.size() > kMostSubjects)
      throw SetupError(file + ": has more than 100 prefixes of markers; expected one per subject");
    without_prefix(track.name);
    owner.points.push_back(std::move(track));
  }
  for (AngleCurve& track : all.angles) {
    RecordedMotion& owner = subject(subject_of(track.name));
    without_prefix(track.name);
    owner.angles.push_back(std::move(track));
  }
  // Whose markers have no prefix beside one whose have: those of the room.
  if (subjects.size() == 2) {
    const auto bare = std::ranges::find(subjects, std::string(), &RecordedMotion::subject);
    if (bare != subjects.end() && bare->points.size() < 3 && bare->angles.empty())
      subjects.erase(bare);
  }
  return subjects;
}

}  // namespace mocap
