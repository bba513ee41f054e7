#include "tools/results/result_columns.h"

#include <cmath>

#include "core/body/body_part.h"
#include "tools/results/fixed_text.h"

namespace mocap {

std::vector<std::string> ResultColumns() {
  std::vector<std::string> columns = {
      "frame",      "timestamp_ns", "state",        "torso_x_mm",   "torso_y_mm",
      "torso_z_mm", "torso_axis_x", "torso_axis_y", "torso_axis_z", "torso_angle_rad"};
  for (int i = 1; i <= kPaperAngleCount; ++i) columns.push_back(PaperAngleColumn(i));
  for (const std::string_view point : kPointNames) {
    for (const char* axis : {"_x_mm", "_y_mm", "_z_mm"})
      columns.push_back(std::string(point) + axis);
  }
  columns.insert(columns.end(), {"residual_mm", "voxels"});
  return columns;
}

std::vector<std::string> FurtherColumns(const BodyRecord& body) {
  std::vector<std::string> columns;
  for (const JointRecord& joint : body.joints) {
    if (joint.paper_angle == 0) columns.push_back(JointColumn(joint.name));
  }
  for (const std::string_view point : kPointNames) columns.push_back(DeviationColumn(point));
  return columns;
}

std::string JointColumn(std::string_view joint) { return std::string(joint) + "_rad"; }

std::string DeviationColumn(std::string_view point) {
  return "deviation_" + std::string(point) + "_mm";
}

std::string PaperAngleColumn(int paper_angle) {
  return "theta_" + std::to_string(paper_angle) + "_rad";
}

void AppendCell(double value, int decimals, std::string& line) {
  line += ',';
  if (!std::isnan(value)) line += FixedText(value, decimals);
}

void AppendPose(const PoseRow& row, std::string& line) {
  if (!row.has_pose) {
    line.append(kPoseCells, ',');
    return;
  }
  for (const double mm : row.paper.torso_mm) AppendCell(mm, 3, line);
  for (const double component : row.paper.torso_axis) AppendCell(component, 6, line);
  AppendCell(row.paper.torso_angle_rad, 6, line);
  for (const double theta_rad : row.paper.theta_rad) AppendCell(theta_rad, 6, line);
  for (const double mm : row.points_W.reshaped()) AppendCell(mm, 3, line);
  AppendCell(row.residual_mm, 3, line);
}

void AppendJoint(const PoseRow& row, std::size_t joint, std::string& line) {
  const auto place = static_cast<Eigen::Index>(joint);
  const bool is_known = row.has_pose && place < row.joint_rad.size();
  AppendCell(is_known ? row.joint_rad[place] : std::nan(""), 6, line);
}

void AppendDeviations(const PoseRow& row, std::string& line) {
  for (const double mm : row.point_std_mm) AppendCell(row.has_pose ? mm : std::nan(""), 3, line);
}

}  // namespace mocap
