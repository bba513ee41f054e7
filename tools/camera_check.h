// Streams from all cameras for a while and finds what is wrong with them.
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
  std::string waits_for;  ///< The camera that triggers it; empty: none that is known.
  std::string error;      ///< Why it could not be started; empty: it could.
  std::vector<std::int64_t> times_ns;
  std::vector<std::uint64_t> sequences;
  int torn = 0;
  int times_lost = 0;  ///< How often it went away.
  CameraFacts facts;

  /// Too few frames came to tell anything of them.
  bool IsSilent() const { return times_ns.size() < 2; }
  std::int64_t MissedFrames() const;
  /// Frames a second that were handed out; 0: too few to tell.
  double Fps() const;
  /// Frames a second that the camera took, whatever became of them; 0: too few to tell.
  double TakenFps() const;
};

/// Watches all cameras at the same time. Nothing is thrown for a camera that does not work.
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

/// How the cameras go together.
struct SetSummary {
  int sets = 0;
  int complete = 0;
  double median_spread_ms = 0;
  double p99_spread_ms = 0;
};
SetSummary SummarizeSets(const std::vector<CameraRun>& runs);

/// Says in one line each what is wrong with a camera, and which one thing to change.
std::vector<std::string> TroublesOf(const CameraRun& run, const std::vector<BusLoad>& loads);
/// The same of cameras that another one triggers.
std::vector<std::string> TriggerTroublesOf(const std::vector<CameraRun>& runs);
/// The same of buses, and of the cameras together.
std::vector<std::string> TroublesOf(const BusLoad& load);
std::vector<std::string> TroublesOf(const SetSummary& sets, const std::vector<CameraRun>& runs);

}  // namespace mocap
