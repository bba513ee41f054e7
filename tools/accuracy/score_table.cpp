#include "tools/accuracy/score_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "drivers/take/text_table.h"

namespace mocap {
namespace {

const std::array<std::string, 8> kScoreColumns = {
    "part", "group", "person", "first", "mean_mm", "p95_mm", "angle_deg", "tracked_share"};
enum ScoreColumn { kPart, kGroup, kPerson, kFirst, kMean, kP95, kAngle, kShare };

std::string PlainName(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == ',' || c == '"' || c == '\n' || c == '\r'; }, '_');
  return name;
}

std::optional<PoseErrors> ErrorsOf(const TableRow& row) {
  if (row.Text(kMean).empty()) return std::nullopt;
  return PoseErrors{row.Number<double>(kMean), row.Number<double>(kP95),
                    row.Number<double>(kAngle)};
}

}  // namespace

const std::string kScoreHeader = fmt::format("{}\n", fmt::join(kScoreColumns, ","));

std::vector<ScoreRow> RowsOf(const std::string& part, const std::string& group,
                             const std::string& person, const PersonScore& score) {
  std::vector<ScoreRow> rows;
  for (std::size_t first = 0; first < score.firsts.size(); ++first)
    rows.push_back({PlainName(part), PlainName(group), PlainName(person), static_cast<int>(first),
                    score.firsts[first].errors, score.firsts[first].tracked_share});
  return rows;
}

std::string ScoreCsv(std::span<const ScoreRow> rows) {
  std::string text = kScoreHeader;
  for (const ScoreRow& row : rows) {
    text += fmt::format("{},{},{},{},", row.part, row.group, row.person, row.first);
    text += row.errors ? fmt::format("{:.3f},{:.3f},{:.4f}", row.errors->mean_mm,
                                     row.errors->p95_mm, row.errors->angle_deg)
                       : ",,";
    text += fmt::format(",{:.5f}\n", row.tracked_share);
  }
  return text;
}

std::vector<ScoreRow> ReadScores(const std::filesystem::path& file) {
  constexpr const char* kWanted = "scores.csv of mocap benchmark";
  TextLines lines(file, kWanted);
  const std::vector<std::string> columns = RequireColumns(lines, kScoreColumns, kWanted);
  std::vector<ScoreRow> rows;
  std::set<std::tuple<std::string, std::string, std::string, int>> keys;
  for (std::string_view line; lines.NextRow(line);) {
    const TableRow row(line, columns, lines);
    rows.push_back({std::string(row.Text(kPart)), std::string(row.Text(kGroup)),
                    std::string(row.Text(kPerson)), row.Number<int>(kFirst), ErrorsOf(row),
                    row.Number<double>(kShare)});
    if (!keys.insert(rows.back().Key()).second)
      lines.Fail(fmt::format("{}, {}, {}, first set {} is there twice; expected one row for each",
                             rows.back().part, rows.back().group, rows.back().person,
                             rows.back().first));
  }
  return rows;
}

}  // namespace mocap
