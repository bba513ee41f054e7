// What a check of a calibration found.
#pragma once

#include <string>

namespace mocap {

enum class Severity { kNote, kWarning, kWrong };

/// One finding, as a line with the remedy.
struct Finding {
  Severity severity = Severity::kNote;
  std::string text;
};

}  // namespace mocap
