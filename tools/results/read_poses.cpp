#include "tools/results/read_poses.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "drivers/quoted.h"
#include "drivers/take/text_table.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

/// A smaller interval means another unit of time: nobody tracks 5000 frames a second.
constexpr std::int64_t kNearest_ns = 200'000;

/// Reads the cells of a row in order.
class RowReader {
 public:
  explicit RowReader(const TableRow& row) : row_(row) {}

  std::string_view Text() const { return row_.Text(next_); }
  void Skip(std::size_t cells) { next_ += cells; }
  template <typename Number>
  Number Next() {
    return row_.Number<Number>(next_++);
  }
  [[noreturn]] void Fail(const std::string& wanted) const { row_.Fail(next_, wanted); }

 private:
  const TableRow& row_;
  std::size_t next_ = 0;
};

CaptureState ReadState(RowReader& row) {
  const auto state = std::ranges::find(kCaptureStateNames, row.Text());
  if (state == kCaptureStateNames.end())
    row.Fail("searching, acquiring, tracking, lost or bridged");
  row.Skip(1);
  return static_cast<CaptureState>(state - kCaptureStateNames.begin());
}

/// A table's columns, and where those are that not every result has.
struct PoseColumns {
  std::vector<std::string> names;
  /// Those of FurtherColumns that the table has, each with its place in the table.
  std::vector<std::pair<FurtherColumn, std::size_t>> further;
};

/// Removes joints beyond the paper's sixteen from the body of an older result.
/// @throws SetupError  when only some of their columns are missing.
PoseColumns FindColumns(std::vector<std::string> names, BodyRecord& body, const TextLines& lines) {
  const std::size_t usual = ResultColumns().size();
  const auto place_of = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto place =
        std::find(names.begin() + static_cast<std::ptrdiff_t>(usual), names.end(), name);
    if (place == names.end()) return {};
    return static_cast<std::size_t>(place - names.begin());
  };
  PoseColumns columns;
  const bool is_older = names.size() == usual;
  if (is_older)
    std::erase_if(body.joints, [](const auto& joint) { return joint.paper_angle == 0; });
  for (const FurtherColumn& column : FurtherColumns(body, ListedJoints::kBeyondPaper)) {
    const std::optional<std::size_t> place = place_of(column.name);
    if (place) {
      columns.further.emplace_back(column, *place);
    } else if (column.is_needed) {
      lines.Fail("has no column " + Quoted(column.name) +
                 "; expected it, as [joints] columns of body.toml names it");
    }
  }
  columns.names = std::move(names);
  return columns;
}

double NumberOrNothing(const TableRow& cells, std::size_t column) {
  if (cells.Text(column).empty()) return std::numeric_limits<double>::quiet_NaN();
  return cells.Number<double>(column);
}

void ReadFurther(const TableRow& cells, const PoseColumns& columns, const BodyRecord& body,
                 PoseRow& row) {
  row.joint_rad.resize(static_cast<Eigen::Index>(body.joints.size()));
  for (Eigen::Index i = 0; i < row.joint_rad.size(); ++i) {
    const int angle = body.joints[static_cast<std::size_t>(i)].paper_angle;
    if (angle > 0) row.joint_rad[i] = row.paper.theta_rad[angle - 1];
  }
  for (const auto& [column, place] : columns.further) {
    const double number = NumberOrNothing(cells, place);
    if (column.is_share && (number < 0 || number > 1)) cells.Fail(place, "a number from 0 to 1");
    column.set_number(row, column.place, number);
  }
}

PoseRow ReadPose(const TableRow& all, const PoseColumns& columns, const BodyRecord& body) {
  RowReader cells(all);
  PoseRow row;
  row.frame = cells.Next<std::int64_t>();
  row.timestamp_ns = cells.Next<std::int64_t>();
  row.state = ReadState(cells);
  row.has_pose = !cells.Text().empty();
  if (row.has_pose) {
    for (double& value : row.paper.torso_mm) value = cells.Next<double>();
    for (double& value : row.paper.torso_axis) value = cells.Next<double>();
    row.paper.torso_angle_rad = cells.Next<double>();
    for (double& value : row.paper.theta_rad) value = cells.Next<double>();
    for (double& value : row.points_W.reshaped()) value = cells.Next<double>();
    row.residual_mm = cells.Next<double>();
    ReadFurther(all, columns, body, row);
  } else {
    cells.Skip(kPoseCells);
  }
  row.voxels = cells.Next<int>();
  return row;
}

void CheckOrder(const PoseRow& before, const PoseRow& row, const TextLines& lines) {
  if (row.timestamp_ns > before.timestamp_ns && row.frame > before.frame) return;
  const bool is_time = row.frame > before.frame;
  lines.Fail(is_time ? "timestamp_ns " + std::to_string(row.timestamp_ns) + " follows " +
                           std::to_string(before.timestamp_ns) +
                           "; expected times in nanoseconds that increase"
                     : "frame " + std::to_string(row.frame) + " follows " +
                           std::to_string(before.frame) + "; frame numbers must increase");
}

/// Checks that times are plausible for tracking.
void CheckTimes(const std::vector<PoseRow>& rows, const std::filesystem::path& file) {
  if (rows.size() < 3) return;
  std::vector<std::int64_t> apart_ns;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    apart_ns.push_back(rows[i].timestamp_ns - rows[i - 1].timestamp_ns);
  }
  std::ranges::nth_element(apart_ns, apart_ns.begin() + apart_ns.size() / 2);
  const std::int64_t usual_ns = apart_ns[apart_ns.size() / 2];
  if (usual_ns >= kNearest_ns) return;
  throw SetupError(file.string() + ": its frames are " + std::to_string(usual_ns) +
                   " ns apart, as if in microseconds or milliseconds; expected timestamp_ns in " +
                   "nanoseconds");
}

}  // namespace

std::vector<PoseRow> ReadPoses(const std::filesystem::path& file, BodyRecord& body,
                               std::vector<std::string>& remarks) {
  TextLines lines(file, kResultWanted);
  const std::vector<std::string> usual = ResultColumns();
  const PoseColumns columns = FindColumns(
      RequireColumns(lines, usual,
                     "frame,timestamp_ns,state,torso_x_mm,... of " + std::to_string(usual.size()) +
                         " columns or more, as mocap track writes it,"),
      body, lines);
  std::vector<PoseRow> rows;
  std::string_view line;
  while (lines.NextRow(line)) {
    const PoseRow row = ReadPose(TableRow(line, columns.names, lines), columns, body);
    if (!rows.empty()) CheckOrder(rows.back(), row, lines);
    rows.push_back(row);
  }
  CheckTimes(rows, file);
  if (!lines.has_end()) {
    remarks.push_back(file.string() + ": the last line has no end; it is read, but may be cut off");
  }
  return rows;
}

}  // namespace mocap
