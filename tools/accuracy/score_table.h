// Scores of a benchmark as a file, to be compared with those of another version.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "tools/accuracy/first_sets.h"

namespace mocap {

/// A run on one person.
struct ScoreRow {
  std::string part;    ///< Of the benchmark.
  std::string group;   ///< How people are filmed, or the folder of takes.
  std::string person;  ///< Number of a varied person, or name of a take or of a person in one.
  int first = 0;       ///< Set with which tracking began.
  std::optional<PoseErrors> errors;  ///< Empty: never tracked.
  double tracked_share = 0;

  /// Rows with the same one are of the same pictures.
  auto Key() const { return std::tie(part, group, person, first); }
};

/// The rows of a person's runs. Commas and quotes in names become underscores.
std::vector<ScoreRow> RowsOf(const std::string& part, const std::string& group,
                             const std::string& person, const PersonScore& score);

/// First line of the table: a file that begins so may be overwritten.
extern const std::string kScoreHeader;

/// A table with a header and a line for each row.
std::string ScoreCsv(std::span<const ScoreRow> rows);
/// Reads such a table.
/// @throws SetupError  naming file and line, also when two rows have the same key.
std::vector<ScoreRow> ReadScores(const std::filesystem::path& file);

}  // namespace mocap
