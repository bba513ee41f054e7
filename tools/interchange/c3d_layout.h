// Description of the points in a C3D file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/interchange/export_format.h"

namespace mocap {

/// Start or end of tracking, or of a foot's contact.
struct C3dEvent {
  std::string label;
  std::string subject;
  double time_s = 0;
  std::string context = "General";  ///< Or "Left", "Right".
  int icon = 0;                     ///< As Vicon's: 1: foot strike, 2: foot off.
};

struct C3dLayout {
  std::vector<std::string> labels;        ///< Of all points, in the order of the data.
  std::vector<std::string> angle_labels;  ///< Labels of the points that are angles.
  std::vector<std::string> subjects, label_prefixes;
  std::vector<C3dEvent> events;
  std::int64_t frames = 0;
  double rate_hz = 0;
  std::string filter = {};  ///< As in Result; empty: none is known.
};

/// Unit of residuals [mm]; negative: the data are floats.
inline constexpr double kC3dScale = -0.25;

/// Returns header and parameters, which precede the data.
std::string C3dBeginning(const C3dLayout& layout);

}  // namespace mocap
