#include "tools/interchange/csv_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "core/degrees.h"
#include "tools/kinematics/joint_angles.h"
#include "tools/results/export_axes.h"
#include "tools/results/fixed_text.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

void AppendDegrees(const BodyAngles& angles, std::string& line) {
  for (const double rad : CoordinatesOf(angles)) AppendCell(kDegreesPerRad * rad, 3, line);
}

}  // namespace

std::vector<std::string> CsvColumns(const BodyRecord& body) {
  std::vector<std::string> columns = ResultColumns();
  // In poses.csv the point torso has the same names.
  for (const char* axis : {"x", "y", "z"}) {
    *std::ranges::find(columns, fmt::format("torso_{}_mm", axis)) =
        fmt::format("torso_origin_{}_mm", axis);
  }
  std::erase(columns, "timestamp_ns");
  columns.insert(columns.begin(), {"time_s", "utime_us"});
  for (const std::string_view name : kCoordinateNames)
    columns.push_back(fmt::format("{}_deg", name));
  for (const FurtherColumn& column : FurtherColumns(body, ListedJoints::kAll))
    columns.push_back(column.name);
  return columns;
}

ExportRemarks WriteCsv(const ExportScene& scene, std::ostream& out) {
  const Result& result = scene.subjects.front().result;
  out << fmt::format("{}\n", fmt::join(CsvColumns(result.body), ","));
  const std::vector<BodyAngles> frames = AnglesOf(result);
  const auto further = FurtherColumns(result.body, ListedJoints::kAll);
  auto angles = frames.begin();
  for (const PoseRow& row : result.poses) {
    const auto since_first_ns =
        static_cast<double>(row.timestamp_ns - scene.moments.front().timestamp_ns);
    std::string line =
        fmt::format("{:.6f},{},{},{}", 1e-9 * since_first_ns, row.timestamp_ns / 1000, row.frame,
                    kCaptureStateNames[static_cast<std::size_t>(row.state)]);
    AppendPose(row, line);
    line += fmt::format(",{}", row.voxels);
    if (IsTracked(row)) {
      AppendDegrees(*angles++, line);
    } else {
      line.append(kCoordinateNames.size(), ',');
    }
    AppendFurther(row, further, line);
    out << line << '\n';
  }
  return {};
}

}  // namespace mocap
