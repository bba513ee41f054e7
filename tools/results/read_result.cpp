#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "config/body_size_fields.h"
#include "config/joint_names.h"
#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "tools/results/people_log.h"
#include "tools/results/pose_log.h"
#include "tools/results/read_poses.h"
#include "tools/results/result.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

/// Names of the paper's angles in results that were written before they had a table of joints.
std::vector<JointRecord> PaperJoints() {
  std::vector<JointRecord> joints;
  for (const std::string_view name : kPaperJointNames) {
    joints.push_back({std::string(name), static_cast<int>(joints.size()) + 1});
  }
  return joints;
}

/// The paper's angle in a column of poses.csv; 0: that of another joint.
int PaperAngleOf(const std::string& column) {
  for (int angle = 1; angle <= kPaperAngleCount; ++angle) {
    if (column == PaperAngleColumn(angle)) return angle;
  }
  return 0;
}

std::vector<JointRecord> ReadJoints(TomlSection& root) {
  std::optional<TomlSection> section = root.Section("joints");
  if (!section) return PaperJoints();
  const std::vector<std::string> names = section->Texts("names");
  const std::vector<std::string> columns = section->Texts("columns");
  if (names.size() != columns.size() || names.size() > kMaxJoints) {
    section->Fail("columns", "has " + Counted(columns.size(), "text") + " for " +
                                 Counted(names.size(), "joint") + "; expected one each, at most " +
                                 std::to_string(kMaxJoints));
  }
  std::vector<JointRecord> joints;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_second = std::ranges::find(joints, names[i], &JointRecord::name) != joints.end();
    if (is_second || !IsJointName(names[i])) {
      section->Fail("names", "has " + Quoted(names[i]) + "; expected names of joints, once each");
    }
    joints.push_back({names[i], PaperAngleOf(columns[i])});
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (joints[i].paper_angle > 0 || columns[i] == JointColumn(names[i])) continue;
    section->Fail("columns", "has " + Quoted(columns[i]) + " for the joint " + names[i] +
                                 "; expected " + JointColumn(names[i]) +
                                 ", or one of theta_1_rad to theta_16_rad");
  }
  return joints;
}

BodyRecord ReadBody(TomlSection& root) {
  BodyRecord body;
  body.model = root.Text("model");
  body.stature_mm = root.Number("stature_mm");
  TomlSection sizes = root.NeededSection("sizes", "a table of the person's sizes");
  for (const BodySizeField& field : kBodySizeFields) {
    body.sizes.*field.value = sizes.Number(std::string(field.name) + "_mm");
  }
  body.joints = ReadJoints(root);
  return body;
}

std::optional<TakeMark> ReadMark(TomlSection& root) {
  std::optional<TomlSection> take = root.Section("take");
  if (!take) return {};
  return TakeMark{take->Text("name"), take->Text("calibration_fnv1a")};
}

std::optional<std::string> ReadFilter(TomlSection& root) {
  std::optional<TomlSection> solve = root.Section("solve");
  if (!solve) return {};
  return solve->Text("filter");
}

bool IsOfOne(const std::filesystem::path& folder) { return IsThere(folder / "poses.csv"); }

/// A take of several people has folders of the same names.
bool IsOnlyTake(const std::filesystem::path& folder) {
  return IsThere(TakeLayout{folder}.Description()) &&
         std::ranges::none_of(PersonFolders(folder), IsOfOne) && !IsOfOne(folder);
}

/// @throws SetupError  for a folder whose poses are not one person's.
void RequireOfOne(const std::filesystem::path& folder) {
  if (IsOfOne(folder)) return;
  if (IsOnlyTake(folder)) {
    throw SetupError(folder.string() +
                     ": is a take, not a result; expected what mocap track TAKE --out RESULT made");
  }
  if (IsOfPeople(folder)) {
    throw SetupError(folder.string() +
                     ": is a result of several people; expected that of one, such as " +
                     PersonFolders(folder).front().string());
  }
  throw SetupError(folder.string() + ": contains no poses.csv; expected " + kResultWanted);
}

/// @throws SetupError  for a file of a result, whose folder is meant.
void RequireNoPart(const std::filesystem::path& file) {
  const std::string name = file.filename();
  if (name != "poses.csv" && name != "body.toml") return;
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  throw SetupError(file.string() + ": is a file of a result; expected its folder, " + folder);
}

}  // namespace

bool IsOfPeople(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_directory(folder, error) && !IsOfOne(folder) && !IsOnlyTake(folder) &&
         !PersonFolders(folder).empty();
}

PeopleResults ReadPeople(const std::filesystem::path& folder_or_log,
                         const std::optional<std::string>& prefix) {
  if (!IsOfPeople(folder_or_log)) {
    std::error_code error;
    if (!std::filesystem::is_directory(folder_or_log, error)) {
      RequireNoPart(folder_or_log);
      return ReadPeopleLog(folder_or_log, prefix);
    }
    if (IsOfOne(folder_or_log)) {
      throw SetupError(folder_or_log.string() +
                       ": is a result of one person; expected that of several, or a log");
    }
    RequireOfOne(folder_or_log);
    throw SetupError(
        folder_or_log.string() +
        ": contains no person-1 or the like; expected what mocap track --people writes, or a log");
  }
  PeopleResults people;
  for (const std::filesystem::path& person : PersonFolders(folder_or_log)) {
    people.emplace_back(person.filename().string(), ReadResult(person));
  }
  return people;
}

Result ReadResult(const std::filesystem::path& folder_or_log,
                  const std::optional<std::string>& prefix) {
  if (!IsThere(folder_or_log)) {
    throw SetupError(folder_or_log.string() + ": not found; expected " + kResultWanted +
                     ", or a log");
  }
  std::error_code error;
  if (!std::filesystem::is_directory(folder_or_log, error)) {
    RequireNoPart(folder_or_log);
    return ReadPoseLog(folder_or_log, prefix);
  }
  if (prefix) {
    throw SetupError(folder_or_log.string() + ": is not a log; only a log has a prefix");
  }
  RequireOfOne(folder_or_log);
  Result result;
  TomlSection body = TomlSection::ReadFile(folder_or_log / "body.toml");
  result.body = ReadBody(body);
  result.take = ReadMark(body);
  result.filter = ReadFilter(body);
  result.poses = ReadPoses(folder_or_log / "poses.csv", result.body, result.remarks);
  return result;
}

}  // namespace mocap
