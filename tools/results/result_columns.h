// The columns of poses.csv, and their cells.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/results/result.h"

namespace mocap {

/// Cells of a pose, from the torso's origin to residual_mm.
inline constexpr std::size_t kPoseCells = 3 + 4 + kPaperAngleCount + 3 * kPointCount + 1;

/// Names of the columns that every result has, in order. torso_x_mm, torso_y_mm and torso_z_mm
/// appear twice: first as the origin of the torso's frame, then as the point torso.
std::vector<std::string> ResultColumns();

/// A column that may follow: not every result has it, and a cell without a number is empty.
struct FurtherColumn {
  std::string name;
  int decimals = 3;
  bool is_needed = false;  ///< The body names it.
  bool is_share = false;   ///< Its numbers are 0 to 1.
  std::size_t place = 0;   ///< Among the numbers of its kind.
  /// Returns the number of a row with a pose; NaN: not known.
  double (*number)(const PoseRow& row, std::size_t place) = nullptr;
  void (*set_number)(PoseRow& row, std::size_t place, double number) = nullptr;
};

/// Joints that have columns of their own.
enum class ListedJoints { kBeyondPaper, kAll };
/// All such columns in order: angles of joints, points that follow the 23, deviations of all
/// points, contacts with the floor, probability.
std::vector<FurtherColumn> FurtherColumns(const BodyRecord& body, ListedJoints joints);

/// The column of a joint that is none of the paper's sixteen: <name>_rad.
std::string JointColumn(std::string_view joint);
/// deviation_<point>_mm
std::string DeviationColumn(std::string_view point);
/// theta_1_rad to theta_16_rad
std::string PaperAngleColumn(int paper_angle);

/// Appends a comma and a number with `decimals`; no number if it is NaN.
void AppendCell(double value, int decimals, std::string& line);
/// Appends the cells from the torso's origin to residual_mm; empty ones if the row has no pose.
void AppendPose(const PoseRow& row, std::string& line);
/// Appends the cells of further columns; empty ones if the row has no pose.
void AppendFurther(const PoseRow& row, std::span<const FurtherColumn> columns, std::string& line);

}  // namespace mocap
