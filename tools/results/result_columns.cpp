#include "tools/results/result_columns.h"

#include "core/body/body_part.h"

namespace mocap {

std::vector<std::string> ResultColumns() {
  std::vector<std::string> columns = {
      "frame",      "timestamp_ns", "state",        "torso_x_mm",   "torso_y_mm",
      "torso_z_mm", "torso_axis_x", "torso_axis_y", "torso_axis_z", "torso_angle_rad"};
  for (int i = 1; i <= kPaperAngleCount; ++i)
    columns.push_back("theta_" + std::to_string(i) + "_rad");
  for (const std::string_view point : kPointNames) {
    for (const char* axis : {"_x_mm", "_y_mm", "_z_mm"})
      columns.push_back(std::string(point) + axis);
  }
  columns.insert(columns.end(), {"residual_mm", "voxels"});
  return columns;
}

}  // namespace mocap
