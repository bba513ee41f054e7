// The truth of a take that has one: where the joints were and how long the parts are.
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
  std::vector<ScoredFrame> frames;    ///< In the order of time, at least one.
  std::vector<std::int64_t> numbers;  ///< Of each in the take.
  double stature_mm = 0;
  std::map<std::string, double> lengths_mm;  ///< Without the unit: "torso", "thigh" …
};

/// The joint of a rig that a scored point is read from.
std::string RigJoint(Point point);

/// Moves the feet of points that were read from RigJoint: a true foot is the sole under the ankle,
/// the shank prolonged.
void ProlongShanks(double ankle_to_sole_mm, ScoredPoints& points_W);

/// Reads truth.csv and truth.toml of a take.
///
/// @return  empty when the take has no truth.csv.
/// @throws SetupError  naming file and line: no row, a column that is missing, a word for a number,
/// times that do not increase, lengths that are none.
std::optional<TakeTruth> ReadTakeTruth(const std::filesystem::path& take);

/// Reads the same of one of several people.
/// @return  empty also when the table has no row: he never came into the room.
/// @throws SetupError  as ReadTakeTruth otherwise.
std::optional<TakeTruth> ReadTruthAmongOthers(const std::filesystem::path& folder);

}  // namespace mocap
