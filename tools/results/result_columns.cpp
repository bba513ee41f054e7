#include "tools/results/result_columns.h"

#include <cmath>

#include "core/body/body_part.h"
#include "drivers/take/truth_columns.h"
#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

double JointIn(const PoseRow& row, std::size_t place) {
  const auto joint = static_cast<Eigen::Index>(place);
  return joint < row.joint_rad.size() ? row.joint_rad[joint] : std::nan("");
}

void SetJointIn(PoseRow& row, std::size_t place, double rad) {
  row.joint_rad[static_cast<Eigen::Index>(place)] = rad;
}

// Of all points, with those that follow the 23.
double DeviationIn(const PoseRow& row, std::size_t point) {
  const auto i = static_cast<Eigen::Index>(point);
  return i < kPointCount ? row.point_std_mm[i] : row.further_std_mm[i - kPointCount];
}

void SetDeviationIn(PoseRow& row, std::size_t point, double mm) {
  const auto i = static_cast<Eigen::Index>(point);
  (i < kPointCount ? row.point_std_mm[i] : row.further_std_mm[i - kPointCount]) = mm;
}

// Of the points that follow the 23: x, y and z of each.
double CoordinateIn(const PoseRow& row, std::size_t place) {
  return row.further_W.reshaped()[static_cast<Eigen::Index>(place)];
}

void SetCoordinateIn(PoseRow& row, std::size_t place, double mm) {
  row.further_W.reshaped()[static_cast<Eigen::Index>(place)] = mm;
}

double ContactIn(const PoseRow& row, std::size_t place) {
  return row.contacts[static_cast<Eigen::Index>(place)];
}

void SetContactIn(PoseRow& row, std::size_t place, double share) {
  row.contacts[static_cast<Eigen::Index>(place)] = share;
}

double ProbabilityIn(const PoseRow& row, std::size_t) { return row.probability; }

void SetProbabilityIn(PoseRow& row, std::size_t, double probability) {
  row.probability = probability;
}

}  // namespace

std::vector<std::string> ResultColumns() {
  std::vector<std::string> columns = {
      "frame",      "timestamp_ns", "state",        "torso_x_mm",   "torso_y_mm",
      "torso_z_mm", "torso_axis_x", "torso_axis_y", "torso_axis_z", "torso_angle_rad"};
  for (int i = 1; i <= kPaperAngleCount; ++i) columns.push_back(PaperAngleColumn(i));
  for (const std::string_view point : kPointNames) {
    for (const std::string& column : PointColumns(point)) columns.push_back(column);
  }
  columns.insert(columns.end(), {"residual_mm", "voxels"});
  return columns;
}

std::vector<FurtherColumn> FurtherColumns(const BodyRecord& body, ListedJoints joints) {
  std::vector<FurtherColumn> columns;
  for (std::size_t i = 0; i < body.joints.size(); ++i) {
    if (joints == ListedJoints::kBeyondPaper && body.joints[i].paper_angle > 0) continue;
    columns.push_back({.name = JointColumn(body.joints[i].name),
                       .decimals = 6,
                       .is_needed = true,
                       .place = i,
                       .number = JointIn,
                       .set_number = SetJointIn});
  }
  for (std::size_t i = 0; i < 3 * kFurtherPointNames.size(); ++i) {
    columns.push_back({.name = PointColumns(kFurtherPointNames[i / 3])[i % 3],
                       .place = i,
                       .number = CoordinateIn,
                       .set_number = SetCoordinateIn});
  }
  for (std::size_t i = 0; i < kPlaceCount; ++i) {
    columns.push_back({.name = DeviationColumn(
                           i < kPointCount ? kPointNames[i] : kFurtherPointNames[i - kPointCount]),
                       .place = i,
                       .number = DeviationIn,
                       .set_number = SetDeviationIn});
  }
  for (std::size_t i = 0; i < kContactCount; ++i) {
    columns.push_back({.name = ContactColumn(kContactNames[i]),
                       .decimals = 3,
                       .is_share = true,
                       .place = i,
                       .number = ContactIn,
                       .set_number = SetContactIn});
  }
  columns.push_back({.name = "probability",
                     .decimals = 4,
                     .is_share = true,
                     .number = ProbabilityIn,
                     .set_number = SetProbabilityIn});
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

void AppendFurther(const PoseRow& row, std::span<const FurtherColumn> columns, std::string& line) {
  if (!row.has_pose) {
    line.append(columns.size(), ',');
    return;
  }
  for (const FurtherColumn& column : columns)
    AppendCell(column.number(row, column.place), column.decimals, line);
}

}  // namespace mocap
