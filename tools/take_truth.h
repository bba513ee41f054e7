// The truth of a take that has one: where the joints were and how long the parts are.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

struct TakeTruth {
  std::vector<ScoredFrame> frames;  ///< In the order of time, at least one.
  double stature_mm = 0;
  std::map<std::string, double> lengths_mm;  ///< Without the unit: "torso", "thigh" …
};

/// Reads truth.csv and truth.toml of a take.
///
/// A true foot is the sole under the ankle: the shank prolonged from the ankle by truth.toml's
/// ankle_to_sole_mm.
/// @return  empty when the take has no truth.csv.
/// @throws SetupError  naming file and line: a column that is missing, a word for a number, times
/// that do not increase, lengths that are none.
std::optional<TakeTruth> ReadTakeTruth(const std::filesystem::path& take);

}  // namespace mocap
