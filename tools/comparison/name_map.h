// A file that says which marker is which.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/comparison/point_names.h"

namespace mocap {

/// An angle of a result, and the other recording's. Its sign may be the opposite.
struct AnglePair {
  std::string own, other;
  double sign = 1;
};

struct NameMap {
  std::vector<NamedPair> points;
  std::vector<AnglePair> angles;
};

/// Reads a map:
///
///     [points]                     # our point = their marker, or several around it
///     knee_l = ["LLFC", "LMFC"]
///     [angles]                     # our angle = theirs; a minus turns its sign
///     knee_angle_l = "-KneeFlexL"
///
/// Names may also stand the other way round (`M7 = "heel_l"`). Our points may have the names of a
/// convention (LHEE).
/// @throws SetupError  names file and line: what is no name of ours, or is named twice.
NameMap ReadNameMap(const std::filesystem::path& file);

}  // namespace mocap
