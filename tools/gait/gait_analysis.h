// What `mocap gait` finds in a result, and its files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "daemon/base/json.h"
#include "tools/gait/event_check.h"
#include "tools/gait/gait_cycle.h"
#include "tools/gait/gait_figures.h"
#include "tools/kinematics/gait_events.h"

namespace mocap {

/// The gait of one person.
struct GaitAnalysis {
  double tracked_s = 0;           ///< Length of all runs.
  std::vector<GaitEvent> events;  ///< In order of time.
  /// If the result has contacts, by which events are found then: how Zeni's agree with them.
  std::optional<EventCheck> check;
  std::vector<Stride> strides;
  GaitSummary summary;
  std::vector<CycleCurve> curves;
};

/// @throws SetupError  when somebody was tracked without points of the feet.
GaitAnalysis AnalyseGait(const Result& result);

/// Fields: tracked_s, events_by, event_check, events, strides, figures, cycle.
Json GaitJson(const GaitAnalysis& gait);
/// Writes events.csv, strides.csv, figures.csv and cycle.csv to a folder, which it creates.
/// @throws std::runtime_error  when they cannot be written.
void WriteGait(const std::filesystem::path& folder, const GaitAnalysis& gait);

}  // namespace mocap
