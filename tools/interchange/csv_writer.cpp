#include "tools/interchange/csv_writer.h"

#include <fmt/format.h>

#include <ostream>
#include <string>

#include "tools/results/fixed_text.h"

namespace mocap {
namespace {

std::string ColumnNames() {
  std::string line =
      "time_s,utime_us,frame,state,torso_x_mm,torso_y_mm,torso_z_mm,torso_axis_x,torso_axis_y,"
      "torso_axis_z,torso_angle_rad";
  for (int i = 1; i <= kPaperAngleCount; ++i) line += fmt::format(",theta_{}_rad", i);
  for (const std::string_view name : kPointNames) {
    line += fmt::format(",{0}_x_mm,{0}_y_mm,{0}_z_mm", name);
  }
  return line + ",residual_mm,voxels\n";
}

void AppendPose(const PoseRow& row, std::string& line) {
  for (const double mm : row.paper.torso_mm) line += ',' + FixedText(mm, 3);
  for (const double component : row.paper.torso_axis) line += ',' + FixedText(component, 6);
  line += ',' + FixedText(row.paper.torso_angle_rad, 6);
  for (const double theta_rad : row.paper.theta_rad) line += ',' + FixedText(theta_rad, 6);
  for (const double mm : row.points_W.reshaped()) line += ',' + FixedText(mm, 3);
  line += ',' + FixedText(row.residual_mm, 3);
}

}  // namespace

ExportRemarks WriteCsv(const ExportScene& scene, std::ostream& out) {
  out << ColumnNames();
  constexpr std::size_t kPoseCells = 3 + 4 + kPaperAngleCount + 3 * kPointCount + 1;
  for (const PoseRow& row : scene.subjects.front().result.poses) {
    const auto since_first_ns =
        static_cast<double>(row.timestamp_ns - scene.moments.front().timestamp_ns);
    std::string line =
        fmt::format("{:.6f},{},{},{}", 1e-9 * since_first_ns, row.timestamp_ns / 1000, row.frame,
                    kCaptureStateNames[static_cast<std::size_t>(row.state)]);
    if (row.has_pose) {
      AppendPose(row, line);
    } else {
      line.append(kPoseCells, ',');
    }
    out << line << ',' << row.voxels << '\n';
  }
  return {};
}

}  // namespace mocap
