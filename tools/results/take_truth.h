// Truth of a take: joint positions and lengths of the parts.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

struct TakeTruth {
  std::vector<ScoredFrame> frames;    ///< In order of time, at least one.
  std::vector<std::int64_t> numbers;  ///< Frame numbers in the take.
  double stature_mm = 0;
  std::map<std::string, double> lengths_mm;  ///< Without the unit in the name: "torso", "thigh" …
};

/// Name of the rig joint for a scored point.
std::string RigJoint(Point point);

/// Moves the feet of points read from RigJoint. A true foot is the sole under the ankle, on the
/// prolonged shank.
void ProlongShanks(double ankle_to_sole_mm, ScoredPoints& points_W);

/// Reads truth.csv and truth.toml of a take.
///
/// @return  empty when the take has no truth.csv.
/// @throws SetupError  naming file and line: no row, a missing column, text instead of a number,
/// times that do not increase, invalid lengths.
std::optional<TakeTruth> ReadTakeTruth(const std::filesystem::path& take);

/// Reads the truth of one of several people.
/// @return  empty also when the table has no row: the person never entered the room.
/// @throws SetupError  as ReadTakeTruth otherwise.
std::optional<TakeTruth> ReadTruthAmongOthers(const std::filesystem::path& folder);

}  // namespace mocap
