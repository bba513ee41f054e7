#include "tools/results/take_truth.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take/take_layout.h"

namespace mocap {
namespace {

std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

/// truth.csv, one row at a time, columns by name.
class TruthTable {
 public:
  explicit TruthTable(const std::filesystem::path& file) : file_(file), in_(file) {
    if (!in_ || !NextRow()) throw SetupError(file.string() + ": is empty; a header is wanted");
    columns_ = std::move(cells_);
  }

  bool NextRow() {
    std::string line;
    if (!std::getline(in_, line)) return false;
    ++line_;
    cells_ = Split(line);
    if (!columns_.empty() && cells_.size() != columns_.size()) {
      Fail(fmt::format("has {} fields; {} are wanted, as in the header", cells_.size(),
                       columns_.size()));
    }
    return true;
  }

  std::size_t Column(const std::string& name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i] == name) return i;
    }
    throw SetupError(file_.string() + ":1: has no column " + name);
  }

  template <typename Number>
  Number Value(std::size_t column) const {
    const std::string& cell = cells_[column];
    Number value{};
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() ||
        !std::isfinite(static_cast<double>(value))) {
      Fail(fmt::format("{} is \"{}\"; a number is wanted", columns_[column], cell.substr(0, 40)));
    }
    return value;
  }

  [[noreturn]] void Fail(const std::string& what) const {
    throw SetupError(fmt::format("{}:{}: {}", file_.string(), line_, what));
  }

 private:
  std::filesystem::path file_;
  std::ifstream in_;
  int line_ = 0;
  std::vector<std::string> columns_;
  std::vector<std::string> cells_;
};

std::vector<ScoredFrame> ReadFrames(const std::filesystem::path& file, double ankle_to_sole_mm) {
  TruthTable table(file);
  const std::size_t time_column = table.Column("timestamp_ns");
  std::array<std::array<std::size_t, 3>, kScoredPointCount> columns;
  for (int i = 0; i < kScoredPointCount; ++i) {
    const std::string joint = RigJoint(kScoredPoints[i]);
    columns[i] = {table.Column(joint + "_x_mm"), table.Column(joint + "_y_mm"),
                  table.Column(joint + "_z_mm")};
  }
  std::vector<ScoredFrame> frames;
  while (table.NextRow()) {
    ScoredFrame frame;
    frame.timestamp_ns = table.Value<std::int64_t>(time_column);
    if (!frames.empty() && frame.timestamp_ns <= frames.back().timestamp_ns) {
      table.Fail("timestamp_ns does not increase");
    }
    for (int i = 0; i < kScoredPointCount; ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        frame.points_W(axis, i) = table.Value<double>(columns[i][axis]);
      }
    }
    ProlongShanks(ankle_to_sole_mm, frame.points_W);
    frames.push_back(std::move(frame));
  }
  if (frames.empty()) throw SetupError(file.string() + ": has no rows; at least one is wanted");
  return frames;
}

}  // namespace

std::string RigJoint(Point point) {
  if (point == Point::kFootL) return "ankle_l";
  if (point == Point::kFootR) return "ankle_r";
  return std::string(kPointNames[static_cast<int>(point)]);
}

void ProlongShanks(double ankle_to_sole_mm, ScoredPoints& points_W) {
  for (int foot = kScoredPointCount - 2; foot < kScoredPointCount; ++foot) {
    const Vector3 shank = points_W.col(foot) - points_W.col(foot - 2);
    points_W.col(foot) += ankle_to_sole_mm * shank.stableNormalized();
  }
}

std::optional<TakeTruth> ReadTakeTruth(const std::filesystem::path& take) {
  const TakeLayout layout{take};
  if (!std::filesystem::exists(layout.TruthTable())) return std::nullopt;
  TomlSection sizes = TomlSection::ReadFile(layout.TruthSizes());
  TakeTruth truth;
  truth.stature_mm = sizes.PositiveNumber("stature_mm");
  const double ankle_to_sole_mm = sizes.NumberWithin("ankle_to_sole_mm", 0, 300);
  if (std::optional<TomlSection> lengths = sizes.Section("lengths")) {
    for (const std::string& key : lengths->Keys()) {
      if (!key.ends_with("_mm"))
        lengths->Fail(key, "has no unit; a name that ends in _mm is wanted");
      truth.lengths_mm[key.substr(0, key.size() - 3)] = lengths->PositiveNumber(key);
    }
  }
  truth.frames = ReadFrames(layout.TruthTable(), ankle_to_sole_mm);
  return truth;
}

}  // namespace mocap
