#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>
#include <utility>

#include "config/body_size_fields.h"
#include "core/errors.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "tools/results/fixed_text.h"
#include "tools/results/result.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

/// Table [lengths] of body.toml.
constexpr std::array<BodySizeField, 6> kLengths = {{{"torso", &BodySizes::torso},
                                                    {"head", &BodySizes::head},
                                                    {"thigh", &BodySizes::thigh},
                                                    {"calf", &BodySizes::calf},
                                                    {"upper_arm", &BodySizes::upper_arm},
                                                    {"lower_arm", &BodySizes::lower_arm}}};

std::string PosesCsv(const Result& result) {
  std::string text;
  for (const std::string& column : ResultColumns()) text += (text.empty() ? "" : ",") + column;
  const auto further = FurtherColumns(result.body, ListedJoints::kBeyondPaper);
  for (const FurtherColumn& column : further) text += ',' + column.name;
  text += '\n';
  for (const PoseRow& row : result.poses) {
    text += std::to_string(row.frame) + ',' + std::to_string(row.timestamp_ns) + ',';
    text += kCaptureStateNames[static_cast<std::size_t>(row.state)];
    AppendPose(row, text);
    text += ',' + std::to_string(row.voxels);
    AppendFurther(row, further, text);
    text += '\n';
  }
  return text;
}

/// Table [joints] of body.toml: every joint, and the column of poses.csv with its angle.
std::string JointsToml(const BodyRecord& body) {
  if (body.joints.empty()) return {};
  std::string names, columns;
  for (const JointRecord& joint : body.joints) {
    const char* separator = names.empty() ? "" : ", ";
    names += separator + TomlText(joint.name);
    columns += separator + TomlText(joint.paper_angle > 0 ? PaperAngleColumn(joint.paper_angle)
                                                          : JointColumn(joint.name));
  }
  return "\n[joints]\nnames = [" + names + "]\ncolumns = [" + columns + "]\n";
}

std::string BodyToml(const Result& result) {
  const BodyRecord& body = result.body;
  const std::optional<TakeMark>& take = result.take;
  std::string text = "model = " + TomlText(body.model) + "\n";
  text += "stature_mm = " + FixedText(body.stature_mm, 1);
  const auto append_table = [&](const char* name, const auto& fields) {
    text += std::string("\n\n[") + name + "]";
    for (const BodySizeField& field : fields) {
      text += '\n' + std::string(field.name) + "_mm = " + FixedText(body.sizes.*field.value, 1);
    }
  };
  append_table("lengths", kLengths);
  append_table("sizes", kBodySizeFields);
  text += '\n' + JointsToml(body);
  if (take)
    text += "\n[take]\nname = " + TomlText(take->name) +
            "\ncalibration_fnv1a = " + TomlText(take->calibration) + '\n';
  if (result.filter) text += "\n[solve]\nfilter = " + TomlText(*result.filter) + '\n';
  return text;
}

const std::string kTracked =
    "," + std::string(kCaptureStateNames[static_cast<std::size_t>(CaptureState::kTracking)]) + ",";
const std::string kPersonPrefix = "person-";

void RemoveResult(const std::filesystem::path& folder) {
  for (const char* name : {"poses.csv", "body.toml"}) std::filesystem::remove(folder / name);
}

void RemovePeople(const std::filesystem::path& folder) {
  for (const std::filesystem::path& person : PersonFolders(folder)) {
    RemoveResult(person);
    std::error_code not_empty;
    std::filesystem::remove(person, not_empty);
  }
}

void RequireRoomForOne(const std::filesystem::path& folder) {
  constexpr std::array<std::string_view, 1> kPoses = {"frame,timestamp_ns,state,"};
  constexpr std::array<std::string_view, 1> kBody = {"model = "};
  MakeFolder(folder);
  for (const char* name : {"poses.csv", "body.toml"}) RequireWritable(folder / name);
  RequireOwn(folder / "poses.csv", kPoses, "a table of poses");
  RequireOwn(folder / "body.toml", kBody, "a measured body");
}

}  // namespace

PoseRow PoseRowOf(std::int64_t frame, std::int64_t capture_ns, const CaptureResult& result,
                  const BodyModel& body) {
  PoseRow row;
  row.frame = frame;
  row.timestamp_ns = capture_ns;
  row.state = result.state;
  row.has_pose = row.state != CaptureState::kSearching;
  if (row.has_pose) {
    row.paper = body.PaperStateOf(result.pose);
    row.points_W = result.points_W;
    row.point_std_mm = result.point_std_mm;
    row.further_W = result.further_W;
    row.further_std_mm = result.further_std_mm;
    row.contacts = result.contacts;
    row.joint_rad = result.pose.theta;
    row.residual_mm = result.residual_mm;
    if (result.probability) row.probability = *result.probability;
  }
  row.voxels = result.voxels;
  return row;
}

BodyRecord RecordOf(const BodyModel& body) {
  BodyRecord record{body.table().name, body.sizes().Stature(), body.sizes()};
  for (const JointAxis& joint : body.table().joints) {
    record.joints.push_back({joint.name, joint.paper_angle});
  }
  return record;
}

std::vector<std::filesystem::path> PersonFolders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> people;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const std::string number =
        name.starts_with(kPersonPrefix) ? name.substr(kPersonPrefix.size()) : std::string();
    const bool is_number =
        !number.empty() && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
    if (is_number && entry.is_directory()) people.push_back(entry.path());
  }
  // Numeric order: person-2 comes before person-10.
  std::ranges::sort(people, {}, [](const std::filesystem::path& person) {
    const std::string name = person.filename().string();
    return std::pair(name.size(), name);
  });
  return people;
}

bool HasPoses(const std::filesystem::path& folder) {
  if (!IsThere(folder)) return false;
  std::vector<std::filesystem::path> results = PersonFolders(folder);
  results.push_back(folder);
  return std::ranges::any_of(results, [](const std::filesystem::path& result) {
    std::ifstream rows(result / "poses.csv");
    std::string row;
    while (std::getline(rows, row)) {
      if (row.find(kTracked) != std::string::npos) return true;
    }
    return false;
  });
}

void RequireRoomForResult(const std::filesystem::path& folder) {
  if (IsThere(TakeLayout{folder}.Description()))
    throw SetupError(folder.string() + ": is a take; expected another folder for the result");
  RequireRoomForOne(folder);
  for (const std::filesystem::path& person : PersonFolders(folder)) RequireRoomForOne(person);
}

void WriteResult(const std::filesystem::path& folder, const Result& result) {
  MakeFolder(folder);
  RemovePeople(folder);
  ReplaceText(folder / "poses.csv", PosesCsv(result));
  ReplaceText(folder / "body.toml", BodyToml(result));
}

void WritePeople(const std::filesystem::path& folder, const std::map<int, Result>& people) {
  MakeFolder(folder);
  RemoveResult(folder);
  RemovePeople(folder);
  for (const auto& [id, result] : people)
    WriteResult(folder / (kPersonPrefix + std::to_string(id)), result);
}

}  // namespace mocap
