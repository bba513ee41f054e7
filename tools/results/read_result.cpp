#include <toml++/toml.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "config/body_size_fields.h"
#include "core/errors.h"
#include "tools/results/pose_log.h"
#include "tools/results/result.h"
#include "tools/results/result_columns.h"

namespace mocap {
namespace {

/// Cells of one line, with what an error must say of them.
class RowReader {
 public:
  RowReader(std::string where, const std::string& line, const std::vector<std::string>& columns)
      : where_(std::move(where)), columns_(columns) {
    std::string_view rest = line;
    for (;;) {
      const std::size_t comma = rest.find(',');
      cells_.push_back(rest.substr(0, comma));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (cells_.size() != columns.size()) {
      throw SetupError(where_ + ": has " + std::to_string(cells_.size()) + " columns, wanted " +
                       std::to_string(columns.size()));
    }
  }

  std::string_view Text() { return cells_[next_++]; }
  bool NextIsEmpty() const { return cells_[next_].empty(); }
  void Skip(std::size_t cells) { next_ += cells; }

  template <typename Number>
  Number Next() {
    const std::string_view cell = cells_[next_];
    Number value{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size()) Fail("a number");
    ++next_;
    return value;
  }

  [[noreturn]] void Fail(const std::string& wanted) const {
    throw SetupError(where_ + ": " + columns_[next_] + " is \"" + std::string(cells_[next_]) +
                     "\", wanted " + wanted);
  }

 private:
  std::string where_;
  const std::vector<std::string>& columns_;
  std::vector<std::string_view> cells_;
  std::size_t next_ = 0;
};

CaptureState ReadState(RowReader& row) {
  for (std::size_t i = 0; i < kCaptureStateNames.size(); ++i) {
    RowReader ahead = row;
    if (ahead.Text() == kCaptureStateNames[i]) {
      row.Skip(1);
      return static_cast<CaptureState>(i);
    }
  }
  row.Fail("searching, acquiring, tracking or lost");
}

PoseRow ReadPose(RowReader cells, std::size_t pose_columns) {
  PoseRow row;
  row.frame = cells.Next<std::int64_t>();
  row.timestamp_ns = cells.Next<std::int64_t>();
  row.state = ReadState(cells);
  row.has_pose = !cells.NextIsEmpty();
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

std::vector<PoseRow> ReadPoses(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw SetupError(file.string() + ": cannot be read, wanted what mocap track writes");
  const std::vector<std::string> columns = ResultColumns();
  std::string header;
  for (const std::string& column : columns) header += (header.empty() ? "" : ",") + column;
  std::string line;
  if (!std::getline(stream, line) || line != header) {
    throw SetupError(file.string() +
                     ":1: has other columns; frame,timestamp_ns,state,… are wanted, as mocap "
                     "track writes them");
  }
  std::vector<PoseRow> rows;
  for (int number = 2; std::getline(stream, line); ++number) {
    RowReader cells(file.string() + ":" + std::to_string(number), line, columns);
    rows.push_back(ReadPose(std::move(cells), columns.size() - kColumnsBesidePose));
  }
  return rows;
}

BodyRecord ReadBody(const std::filesystem::path& file) {
  toml::table table;
  try {
    table = toml::parse_file(file.string());
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw SetupError(file.string() + (line ? ":" + std::to_string(line) : "") + ": " +
                     std::string(error.description()));
  }
  const auto require = [&](const auto& value, const std::string& key, const char* wanted) {
    if (!value) throw SetupError(file.string() + ": " + key + ": missing, wanted " + wanted);
    return *value;
  };
  BodyRecord body;
  body.model = require(table["model"].value<std::string>(), "model", "a body table's name");
  body.stature_mm = require(table["stature_mm"].value<double>(), "stature_mm", "a length");
  for (const BodySizeField& field : kBodySizeFields) {
    const std::string key = std::string(field.name) + "_mm";
    body.sizes.*field.value =
        require(table["sizes"][key].value<double>(), "sizes." + key, "a length");
  }
  return body;
}

/// Both TOML and CSV can spell numbers that are none, and a message can carry them.
void RejectNonFinite(const Result& result, const std::filesystem::path& folder_or_log) {
  bool body_is_finite = std::isfinite(result.body.stature_mm);
  for (const BodySizeField& field : kBodySizeFields) {
    body_is_finite &= std::isfinite(result.body.sizes.*field.value);
  }
  if (!body_is_finite) {
    throw SetupError(folder_or_log.string() + ": the body has a size that is no finite number");
  }
  for (const PoseRow& row : result.poses) {
    if (!row.has_pose) continue;
    double sum = row.paper.torso_mm.sum() + row.paper.torso_axis.sum() + row.paper.torso_angle_rad +
                 row.points_W.sum() + row.residual_mm;
    for (const double theta_rad : row.paper.theta_rad) sum += theta_rad;
    if (!std::isfinite(sum)) {
      throw SetupError(folder_or_log.string() + ": frame " + std::to_string(row.frame) +
                       " has a number that is not finite");
    }
  }
}

}  // namespace

Result ReadResult(const std::filesystem::path& folder_or_log) {
  if (!std::filesystem::exists(folder_or_log)) {
    throw SetupError(folder_or_log.string() + ": is missing, wanted what mocap track leaves");
  }
  const Result result =
      std::filesystem::is_directory(folder_or_log)
          ? Result{ReadBody(folder_or_log / "body.toml"), ReadPoses(folder_or_log / "poses.csv")}
          : ReadPoseLog(folder_or_log);
  RejectNonFinite(result, folder_or_log);
  return result;
}

}  // namespace mocap
