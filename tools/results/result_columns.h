// The columns of poses.csv, and their cells.
#pragma once

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
/// Names of the columns that may follow: angles of the joints beyond the paper's sixteen, and the
/// deviations of the 23 points.
std::vector<std::string> FurtherColumns(const BodyRecord& body);

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
/// Appends the angle of a joint, by its place in BodyRecord::joints.
void AppendJoint(const PoseRow& row, std::size_t joint, std::string& line);
/// Appends the deviations of the 23 points.
void AppendDeviations(const PoseRow& row, std::string& line);

}  // namespace mocap
