#include <cinttypes>
#include <cstdio>

#include "config/body_size_fields.h"
#include "drivers/take/text_file.h"
#include "tools/results/result.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

/// Lengths of body.toml's table [lengths].
constexpr std::array<BodySizeField, 6> kLengths = {{{"torso", &BodySizes::torso},
                                                    {"head", &BodySizes::head},
                                                    {"thigh", &BodySizes::thigh},
                                                    {"calf", &BodySizes::calf},
                                                    {"upper_arm", &BodySizes::upper_arm},
                                                    {"lower_arm", &BodySizes::lower_arm}}};

void AppendNumber(std::string& text, const char* format, double value) {
  char digits[64];
  std::snprintf(digits, sizeof digits, format, value);
  // A minus before zero would make equal numbers differ.
  const bool is_zero = std::string_view(digits).find_first_not_of("-0.") == std::string_view::npos;
  text += is_zero && digits[0] == '-' ? digits + 1 : digits;
}

void AppendPose(std::string& line, const PoseRow& row) {
  for (int axis = 0; axis < 3; ++axis) AppendNumber(line += ',', "%.3f", row.paper.torso_mm[axis]);
  for (int axis = 0; axis < 3; ++axis) {
    AppendNumber(line += ',', "%.6f", row.paper.torso_axis[axis]);
  }
  AppendNumber(line += ',', "%.6f", row.paper.torso_angle_rad);
  for (const double theta : row.paper.theta_rad) AppendNumber(line += ',', "%.6f", theta);
  for (const double coordinate : row.points_W.reshaped()) {
    AppendNumber(line += ',', "%.3f", coordinate);
  }
  AppendNumber(line += ',', "%.3f", row.residual_mm);
}

std::string PosesCsv(const Result& result) {
  const std::vector<std::string> columns = ResultColumns();
  std::string text;
  for (const std::string& column : columns) text += (text.empty() ? "" : ",") + column;
  text += '\n';
  const std::size_t pose_columns = columns.size() - kColumnsBesidePose;
  for (const PoseRow& row : result.poses) {
    text += std::to_string(row.frame) + ',' + std::to_string(row.timestamp_ns) + ',';
    text += kCaptureStateNames[static_cast<std::size_t>(row.state)];
    if (row.has_pose) {
      AppendPose(text, row);
    } else {
      text.append(pose_columns, ',');
    }
    text += ',' + std::to_string(row.voxels) + '\n';
  }
  return text;
}

std::string BodyToml(const BodyRecord& body) {
  std::string text = "model = \"" + body.model + "\"\n";
  AppendNumber(text += "stature_mm = ", "%.1f", body.stature_mm);
  const auto append_table = [&](const char* name, const auto& fields) {
    text += std::string("\n\n[") + name + "]";
    for (const BodySizeField& field : fields) {
      text += '\n' + std::string(field.name) + "_mm = ";
      AppendNumber(text, "%.1f", body.sizes.*field.value);
    }
  };
  append_table("lengths", kLengths);
  append_table("sizes", kBodySizeFields);
  return text + '\n';
}

}  // namespace

BodyRecord RecordOf(const BodyModel& body) {
  return {body.table().name, body.sizes().Stature(), body.sizes()};
}

void WriteResult(const std::filesystem::path& folder, const Result& result) {
  std::filesystem::create_directories(folder);
  ReplaceText(folder / "poses.csv", PosesCsv(result));
  ReplaceText(folder / "body.toml", BodyToml(result.body));
}

}  // namespace mocap
