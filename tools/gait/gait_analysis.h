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
  std::vector<StancePhase> stances;
  /// How events by position (Zeni et al. 2008) agree with those by contact. Empty: the result has
  /// no contacts, and events are by position.
  std::optional<EventCheck> check;
  std::vector<Stride> strides;
  GaitSummary summary;
  std::vector<CycleCurve> curves;
};

/// @param where  names the result in errors.
/// @throws SetupError  when somebody was tracked, but always without points of the feet.
GaitAnalysis AnalyseGait(const Result& result, const std::string& where);

/// Fields: tracked_s, events_by, event_check, events, strides, figures, cycle.
Json GaitJson(const GaitAnalysis& gait);
/// Checks that WriteGait overwrites nothing but tables of its own, and creates the folder.
/// @throws SetupError  naming what is in the way.
void RequireRoomForGait(const std::filesystem::path& folder);

/// Writes events.csv, strides.csv, figures.csv and cycle.csv to a folder.
/// @throws std::runtime_error  when they cannot be written.
void WriteGait(const std::filesystem::path& folder, const GaitAnalysis& gait);

}  // namespace mocap
