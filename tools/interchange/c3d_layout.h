// What a C3D file says of its points beside where they are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/interchange/export_format.h"

namespace mocap {

/// A start or an end of tracking.
struct C3dEvent {
  std::string label;
  std::string subject;
  double time_s = 0;
};

struct C3dLayout {
  std::vector<std::string> labels;        ///< Of all points, in the order of the data.
  std::vector<std::string> angle_labels;  ///< Of those among them that are angles.
  std::vector<std::string> subjects, label_prefixes;
  std::vector<C3dEvent> events;
  std::int64_t frames = 0;
  double rate_hz = 0;
};

/// Residuals are counted in this [mm]; negative: the data are floats.
inline constexpr double kC3dScale = -0.25;

/// Header and parameters: all that stands before the data.
std::string C3dBeginning(const C3dLayout& layout);

}  // namespace mocap
