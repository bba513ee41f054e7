#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "core/degrees.h"
#include "core/errors.h"
#include "drivers/lowered.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "tools/comparison/c3d_file.h"
#include "tools/comparison/comparison.h"
#include "tools/comparison/text_motion.h"

namespace mocap {
namespace {

constexpr const char* kExpectedOther =
    "expected a .c3d, .trc, .bvh, .mot or .csv file, a take with truth, a result, or an LCM log";
constexpr std::size_t kMostC3dBytes = std::size_t{512} << 20;

bool Lists(const C3dFile& c3d, const char* group, const std::string& label) {
  const std::vector<std::string> labels = c3d.Texts(group);
  return std::ranges::find(labels, label) != labels.end();
}

bool IsAngle(const C3dFile& c3d, const std::string& label) {
  return Lists(c3d, "POINT:ANGLES", label) || label.ends_with("Angles");
}

/// Whether a point is a force or the like, which Plug-in Gait writes among the points.
bool IsNoPlace(const C3dFile& c3d, const std::string& label) {
  constexpr std::array kGroups = {"POINT:FORCES", "POINT:MOMENTS", "POINT:POWERS", "POINT:SCALARS",
                                  "POINT:REACTIONS"};
  constexpr std::array<std::string_view, 4> kEnds = {"Force", "Moment", "Power", "Forces"};
  return std::ranges::any_of(kGroups, [&](auto group) { return Lists(c3d, group, label); }) ||
         std::ranges::any_of(kEnds, [&](auto end) { return label.ends_with(end); });
}

void AddC3dAngles(const std::string& label, const std::vector<Vector3>& values, double factor,
                  RecordedMotion& motion) {
  for (int axis = 0; axis < 3; ++axis) {
    AngleCurve& track = motion.angles.emplace_back();
    track.name = label + '.' + "xyz"[axis];
    for (const Vector3& value : values) track.deg.push_back(factor * value[axis]);
  }
}

MotionFile ReadC3dMotion(const std::filesystem::path& file) {
  const std::string name = Printable(file.string());
  const std::string bytes = ReadWholeFile(file, "a C3D file", kMostC3dBytes);
  C3dFile c3d = ParseC3d(bytes, name);
  const std::vector<std::string> units = c3d.Texts("POINT:UNITS");
  const std::optional<double> unit =
      units.empty() || units[0].empty() ? std::nullopt : UnitInMm(units[0]);
  if (!units.empty() && !units[0].empty() && !unit)
    throw SetupError(name + ": POINT:UNITS is " + Printable(units[0]) + "; expected mm or m");
  const std::vector<std::string> angle_units = c3d.Texts("POINT:ANGLE_UNITS");
  const bool in_rad = !angle_units.empty() && angle_units[0].starts_with("rad");
  RecordedMotion all;
  all.has_unit = unit.has_value();
  const std::size_t frames = c3d.points.front().size();
  for (std::size_t f = 0; f < frames; ++f)
    all.time_s.push_back(static_cast<double>(f) / c3d.rate_hz);
  for (std::size_t i = 0; i < c3d.labels.size(); ++i) {
    const std::string& label = c3d.labels[i];
    if (IsAngle(c3d, label)) {
      AddC3dAngles(label, c3d.points[i], in_rad ? kDegreesPerRad : 1, all);
    } else if (!IsNoPlace(c3d, label)) {
      for (Vector3& p : c3d.points[i]) p *= unit.value_or(1);
      all.points.push_back({label, std::move(c3d.points[i])});
    }
  }
  if (frames == 0) throw SetupError(name + ": has no frame; expected at least one");
  MotionFile read{"C3D", BySubject(std::move(all), name), {}};
  if (static_cast<std::int64_t>(frames) < c3d.declared_frames) {
    read.remarks.push_back(name + ": is cut off: has " + std::to_string(frames) + " of " +
                           std::to_string(c3d.declared_frames) + " frames");
  }
  return read;
}

/// Results have angles by two conventions, and points for files that have no others.
RecordedMotion OtherMotionOf(const Result& result, const std::string& name) {
  RecordedMotion motion = MotionOf(result).motion;
  motion.subject = name;
  std::erase_if(motion.angles,
                [](const AngleCurve& track) { return track.name.find('.') != std::string::npos; });
  std::erase_if(motion.points, [](const PointTrack& track) { return track.name == kPelvisOrigin; });
  return motion;
}

MotionFile ReadOtherResult(const std::filesystem::path& path,
                           const std::optional<std::string>& prefix) {
  MotionFile read{"result", {}, {}};
  if (!IsOfPeople(path)) {
    const Result result = ReadResult(path, prefix);
    read.remarks = result.remarks;
    read.subjects.push_back(OtherMotionOf(result, ""));
    return read;
  }
  for (const auto& [name, result] : ReadPeople(path, prefix))
    if (std::ranges::any_of(result.poses, [](const PoseRow& row) { return row.has_pose; }))
      read.subjects.push_back(OtherMotionOf(result, name));
  return read;
}

/// truth.csv of a take, or of each of its people; none if it has no truth.
MotionFile ReadTruthOf(const std::filesystem::path& take) {
  MotionFile read{"truth", {}, {}};
  const std::filesystem::path table = TakeLayout{take}.TruthTable();
  if (IsThere(table)) return ReadCsvMotion(table);
  for (const std::filesystem::path& folder : PersonFolders(take)) {
    const std::filesystem::path of_person = TakeLayout{folder}.TruthTable();
    if (!IsThere(of_person)) continue;
    RecordedMotion motion = std::move(ReadCsvMotion(of_person).subjects.front());
    motion.subject = folder.filename().string();
    read.subjects.push_back(std::move(motion));
  }
  return read;
}

/// Whether a file begins as those of lcm-logger: with the sync word of the first event.
bool IsLog(const std::filesystem::path& file) {
  constexpr std::string_view kSyncWord = "\xED\xA1\xDA\x01";
  std::string begin(kSyncWord.size(), 0);
  std::ifstream in(file, std::ios::binary);
  return in.read(begin.data(), std::ssize(begin)) && begin == kSyncWord;
}

MotionFile ReadBySuffix(const std::filesystem::path& path,
                        const std::optional<std::string>& prefix) {
  const std::string suffix = Lowered(path.extension().string());
  if (suffix == ".c3d") return ReadC3dMotion(path);
  if (suffix == ".trc") return ReadTrc(path);
  if (suffix == ".mot" || suffix == ".sto") return ReadMot(path);
  if (suffix == ".bvh") return ReadBvh(path);
  if (suffix == ".csv") return ReadCsvMotion(path);
  if (IsLog(path)) return ReadOtherResult(path, prefix);
  throw SetupError(Printable(path.string()) + ": cannot be compared; " + kExpectedOther);
}

}  // namespace

MotionFile ReadMotionFile(const std::filesystem::path& file,
                          const std::optional<std::string>& prefix) {
  if (!IsThere(file)) {
    throw SetupError(Printable(file.string()) + ": not found; " + kExpectedOther);
  }
  std::error_code error;
  if (!std::filesystem::is_directory(file, error)) return ReadBySuffix(file, prefix);
  if (!IsThere(file / "poses.csv")) {
    MotionFile truth = ReadTruthOf(file);
    if (!truth.subjects.empty()) return truth;
  }
  return ReadOtherResult(file, prefix);
}

}  // namespace mocap
