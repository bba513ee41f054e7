// Streams from all cameras for a while and reports their faults.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "config/open_live.h"

namespace mocap {

/// Observations of one camera.
struct CameraRun {
  std::string name;
  CameraRequest request;
  std::string waits_for;  ///< The camera that triggers it; empty: none known.
  std::string error;      ///< Why it could not be started; empty: it started.
  std::vector<std::int64_t> times_ns;
  std::vector<std::uint64_t> sequences;
  int torn = 0;
  int times_lost = 0;  ///< How often it went away.
  CameraFacts facts;

  /// Too few frames came for any estimate.
  bool IsSilent() const { return times_ns.size() < 2; }
  std::int64_t MissedFrames() const;
  /// Delivered frames per second; 0: too few to tell.
  double Fps() const;
  /// Captured frames per second, delivered or not; 0: too few to tell.
  double TakenFps() const;
};

/// Records all cameras at the same time. Throws nothing for a faulty camera.
std::vector<CameraRun> WatchCameras(std::vector<LiveCamera>& cameras, double seconds);

/// Observations that concern several cameras.
struct BusLoad {
  std::string bus;
  double used_mbit_s = 0;
  double link_mbit_s = 0;
  std::vector<std::string> cameras;

  double share() const { return link_mbit_s > 0 ? used_mbit_s / link_mbit_s : 0; }
};
std::vector<BusLoad> LoadsOf(const std::vector<CameraRun>& runs);

/// Agreement of the cameras' capture times.
struct SetSummary {
  int sets = 0;
  int complete = 0;
  double median_spread_ms = 0;
  double p99_spread_ms = 0;
};
SetSummary SummarizeSets(const std::vector<CameraRun>& runs);

/// Describes each fault of a camera in one line, with the one thing to change.
std::vector<std::string> TroublesOf(const CameraRun& run, const std::vector<BusLoad>& loads);
/// Faults of cameras triggered by another one.
std::vector<std::string> TriggerTroublesOf(const std::vector<CameraRun>& runs);
/// Faults of a bus, and of the cameras as a group.
std::vector<std::string> TroublesOf(const BusLoad& load);
std::vector<std::string> TroublesOf(const SetSummary& sets, const std::vector<CameraRun>& runs);

}  // namespace mocap
