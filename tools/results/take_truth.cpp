#include "tools/results/take_truth.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "config/toml_section.h"
#include "core/errors.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/text_table.h"

namespace mocap {
namespace {

/// Reads truth.csv row by row; finds columns by name.
class TruthTable {
 public:
  explicit TruthTable(const std::filesystem::path& file) : lines_(file, "a table of joints") {
    std::string_view header;
    if (!lines_.Next(header)) lines_.Fail("is empty; expected a header");
    for (std::size_t begin = 0; begin <= header.size();) {
      const std::size_t end = std::min(header.find(',', begin), header.size());
      columns_.emplace_back(header.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  std::optional<TableRow> NextRow() {
    std::string_view line;
    if (!lines_.NextRow(line)) return std::nullopt;
    return TableRow(line, columns_, lines_);
  }

  std::optional<std::size_t> Find(const std::string& name) const {
    const auto column = std::ranges::find(columns_, name);
    if (column == columns_.end()) return std::nullopt;
    return static_cast<std::size_t>(column - columns_.begin());
  }
  std::optional<std::array<std::size_t, 3>> FindAll(const std::array<std::string, 3>& names) const {
    if (!Find(names[0])) return std::nullopt;
    return std::array{Column(names[0]), Column(names[1]), Column(names[2])};
  }
  /// @pre  no row has been read.
  std::size_t Column(const std::string& name) const {
    const std::optional<std::size_t> column = Find(name);
    if (!column) lines_.Fail("has no column " + name + ", separated by commas");
    return *column;
  }

  [[noreturn]] void Fail(const std::string& what) const { lines_.Fail(what); }

 private:
  TextLines lines_;
  std::vector<std::string> columns_;
};

Vector3 VectorIn(const TableRow& row, const std::array<std::size_t, 3>& columns) {
  return {row.Number<double>(columns[0]), row.Number<double>(columns[1]),
          row.Number<double>(columns[2])};
}

/// Reads what a table may have of hands, feet and head.
class ExtremityColumns {
 public:
  explicit ExtremityColumns(const TruthTable& table) {
    for (const std::string_view point : kFurtherPointNames)
      points_.push_back(table.FindAll(PointColumns(point)));
    for (const std::string_view segment : kTurnedSegmentNames)
      rotations_.push_back(table.FindAll(RotationColumns(segment)));
    for (const std::string_view point : kContactNames)
      contacts_.push_back(table.Find(ContactColumn(point)));
  }

  TrueExtremities Read(const TableRow& row) const {
    TrueExtremities truth;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (points_[i]) truth.points_W.col(i) = VectorIn(row, *points_[i]);
    for (std::size_t i = 0; i < rotations_.size(); ++i)
      if (rotations_[i]) truth.rotations.col(i) = VectorIn(row, *rotations_[i]);
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (contacts_[i]) truth.contacts[i] = row.Number<double>(*contacts_[i]);
    return truth;
  }

 private:
  std::vector<std::optional<std::array<std::size_t, 3>>> points_, rotations_;
  std::vector<std::optional<std::size_t>> contacts_;
};

void ReadFrames(const std::filesystem::path& file, double ankle_to_sole_mm, TakeTruth& truth) {
  TruthTable table(file);
  const std::optional<std::size_t> number_column = table.Find("frame");
  const std::size_t time_column = table.Column("timestamp_ns");
  std::array<std::array<std::size_t, 3>, kScoredPointCount> columns;
  for (int i = 0; i < kScoredPointCount; ++i) {
    const std::array<std::string, 3> names = PointColumns(RigJoint(kScoredPoints[i]));
    columns[i] = {table.Column(names[0]), table.Column(names[1]), table.Column(names[2])};
  }
  const ExtremityColumns extremities(table);
  std::vector<ScoredFrame>& frames = truth.frames;
  while (const std::optional<TableRow> row = table.NextRow()) {
    ScoredFrame frame;
    frame.timestamp_ns = row->Number<std::int64_t>(time_column);
    if (!frames.empty() && frame.timestamp_ns <= frames.back().timestamp_ns) {
      table.Fail("timestamp_ns " + std::to_string(frame.timestamp_ns) + " follows " +
                 std::to_string(frames.back().timestamp_ns) +
                 "; expected times in nanoseconds that increase");
    }
    for (int i = 0; i < kScoredPointCount; ++i) frame.points_W.col(i) = VectorIn(*row, columns[i]);
    ProlongShanks(ankle_to_sole_mm, frame.points_W);
    frames.push_back(std::move(frame));
    truth.extremities.push_back(extremities.Read(*row));
    truth.numbers.push_back(number_column ? row->Number<std::int64_t>(*number_column)
                                          : static_cast<std::int64_t>(truth.numbers.size()));
  }
}

}  // namespace

void TakeTruth::Add(const TakeTruth& other, std::size_t frame) {
  frames.push_back(other.frames[frame]);
  numbers.push_back(other.numbers[frame]);
  if (!other.extremities.empty()) extremities.push_back(other.extremities[frame]);
}

void TakeTruth::RemoveFirst(std::size_t count) {
  const auto shorten = [count](auto& list) {
    list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count));
  };
  shorten(frames);
  shorten(numbers);
  if (!extremities.empty()) shorten(extremities);
}

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

std::optional<TakeTruth> ReadTruthAmongOthers(const std::filesystem::path& folder) {
  const TakeLayout layout{folder};
  if (!IsThere(layout.TruthTable())) return std::nullopt;
  TomlSection sizes = TomlSection::ReadFile(layout.TruthSizes());
  TakeTruth truth;
  truth.stature_mm = sizes.PositiveNumber("stature_mm");
  const double ankle_to_sole_mm = sizes.NumberWithin("ankle_to_sole_mm", 0, 300);
  if (std::optional<TomlSection> lengths = sizes.Section("lengths")) {
    for (const std::string& key : lengths->Keys()) {
      if (!key.ends_with("_mm"))
        lengths->Fail(key, "has no unit; expected a name that ends in _mm");
      truth.lengths_mm[key.substr(0, key.size() - 3)] = lengths->PositiveNumber(key);
    }
  }
  ReadFrames(layout.TruthTable(), ankle_to_sole_mm, truth);
  if (truth.frames.empty()) return std::nullopt;
  return truth;
}

std::optional<TakeTruth> ReadTakeTruth(const std::filesystem::path& take) {
  std::optional<TakeTruth> truth = ReadTruthAmongOthers(take);
  const std::filesystem::path table = TakeLayout{take}.TruthTable();
  if (!truth && IsThere(table)) {
    throw SetupError(table.string() + ": has no rows; expected at least one");
  }
  return truth;
}

}  // namespace mocap
