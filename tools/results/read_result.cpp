#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "config/body_size_fields.h"
#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_table.h"
#include "tools/results/people_log.h"
#include "tools/results/pose_log.h"
#include "tools/results/result.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

constexpr const char* kWanted = "what mocap track writes";
/// A smaller interval means another unit of time: nobody tracks 5000 frames a second.
constexpr std::int64_t kNearest_ns = 200'000;

/// Reads the cells of a row in order.
class RowReader {
 public:
  RowReader(std::string_view line, std::span<const std::string> columns, const TextLines& lines)
      : row_(line, columns, lines) {}

  std::string_view Text() const { return row_.Text(next_); }
  void Skip(std::size_t cells) { next_ += cells; }
  template <typename Number>
  Number Next() {
    return row_.Number<Number>(next_++);
  }
  [[noreturn]] void Fail(const std::string& wanted) const { row_.Fail(next_, wanted); }

 private:
  TableRow row_;
  std::size_t next_ = 0;
};

CaptureState ReadState(RowReader& row) {
  const auto state = std::ranges::find(kCaptureStateNames, row.Text());
  if (state == kCaptureStateNames.end()) row.Fail("searching, acquiring, tracking or lost");
  row.Skip(1);
  return static_cast<CaptureState>(state - kCaptureStateNames.begin());
}

PoseRow ReadPose(RowReader cells, std::size_t pose_columns) {
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
  } else {
    cells.Skip(pose_columns);
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
                   " ns apart: are these microseconds or milliseconds? Expected timestamp_ns in " +
                   "nanoseconds");
}

std::vector<PoseRow> ReadPoses(const std::filesystem::path& file,
                               std::vector<std::string>& remarks) {
  TextLines lines(file, kWanted);
  const std::vector<std::string> columns = ResultColumns();
  std::string header;
  for (const std::string& column : columns) header += (header.empty() ? "" : ",") + column;
  RequireHeader(lines, std::span(&header, 1),
                "frame,timestamp_ns,state,torso_x_mm,... of " + std::to_string(columns.size()) +
                    " columns, as mocap track writes it,");
  std::vector<PoseRow> rows;
  std::string_view line;
  while (lines.NextRow(line)) {
    const PoseRow row =
        ReadPose(RowReader(line, columns, lines), columns.size() - kColumnsBesidePose);
    if (!rows.empty()) CheckOrder(rows.back(), row, lines);
    rows.push_back(row);
  }
  CheckTimes(rows, file);
  if (!lines.has_end()) {
    remarks.push_back(file.string() + ": the last line has no end; it is read, but may be cut off");
  }
  return rows;
}

BodyRecord ReadBody(TomlSection& root) {
  BodyRecord body;
  body.model = root.Text("model");
  body.stature_mm = root.Number("stature_mm");
  TomlSection sizes = root.NeededSection("sizes", "a table of the person's sizes");
  for (const BodySizeField& field : kBodySizeFields) {
    body.sizes.*field.value = sizes.Number(std::string(field.name) + "_mm");
  }
  return body;
}

std::optional<TakeMark> ReadMark(TomlSection& root) {
  std::optional<TomlSection> take = root.Section("take");
  if (!take) return {};
  return TakeMark{take->Text("name"), take->Text("calibration_fnv1a")};
}

bool IsOfOne(const std::filesystem::path& folder) { return IsThere(folder / "poses.csv"); }

/// A take of several people has folders of the same names.
bool IsOnlyTake(const std::filesystem::path& folder) {
  return IsThere(TakeLayout{folder}.Description()) &&
         std::ranges::none_of(PersonFolders(folder), IsOfOne) && !IsOfOne(folder);
}

/// @throws SetupError  for a folder whose poses are not one person's.
void RequireOfOne(const std::filesystem::path& folder) {
  if (IsOfOne(folder)) return;
  if (IsOnlyTake(folder)) {
    throw SetupError(folder.string() +
                     ": is a take, not a result; expected what mocap track TAKE --out RESULT made");
  }
  if (IsOfPeople(folder)) {
    throw SetupError(folder.string() +
                     ": is a result of several people; expected that of one, such as " +
                     PersonFolders(folder).front().string());
  }
}

}  // namespace

bool IsOfPeople(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_directory(folder, error) && !IsOfOne(folder) && !IsOnlyTake(folder) &&
         !PersonFolders(folder).empty();
}

PeopleResults ReadPeople(const std::filesystem::path& folder_or_log,
                         const std::optional<std::string>& prefix) {
  if (!IsOfPeople(folder_or_log)) {
    std::error_code error;
    if (!std::filesystem::is_directory(folder_or_log, error)) {
      return ReadPeopleLog(folder_or_log, prefix);
    }
    if (IsOfOne(folder_or_log)) {
      throw SetupError(folder_or_log.string() +
                       ": is a result of one person; expected that of several, or a log");
    }
    RequireOfOne(folder_or_log);
    throw SetupError(
        folder_or_log.string() +
        ": contains no person-1 or the like; expected what mocap track --people writes, or a log");
  }
  PeopleResults people;
  for (const std::filesystem::path& person : PersonFolders(folder_or_log)) {
    people.emplace_back(person.filename().string(), ReadResult(person));
  }
  return people;
}

Result ReadResult(const std::filesystem::path& folder_or_log,
                  const std::optional<std::string>& prefix) {
  if (!IsThere(folder_or_log)) {
    throw SetupError(folder_or_log.string() + ": not found; expected " + kWanted + ", or a log");
  }
  std::error_code error;
  if (!std::filesystem::is_directory(folder_or_log, error)) {
    return ReadPoseLog(folder_or_log, prefix);
  }
  if (prefix) {
    throw SetupError(folder_or_log.string() + ": is not a log; only a log has a prefix");
  }
  RequireOfOne(folder_or_log);
  Result result;
  result.poses = ReadPoses(folder_or_log / "poses.csv", result.remarks);
  TomlSection body = TomlSection::ReadFile(folder_or_log / "body.toml");
  result.body = ReadBody(body);
  result.take = ReadMark(body);
  return result;
}

}  // namespace mocap
