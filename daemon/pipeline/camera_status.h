// The status of one camera.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/pipeline/health_watch.h"

namespace mocap {

/// Numbers as in camera_status_t.
enum class CameraState { kStarting = 0, kStreaming = 1, kLost = 2, kEnded = 3 };

/// A camera's counters at one moment.
struct CameraStatus {
  std::string name;
  std::string node;  ///< The node that has its driver; empty: this computer.
  CameraState state = CameraState::kStarting;
  std::int64_t frames = 0;
  std::int64_t dropped = 0;  ///< Gaps in the camera's count, and frames dropped on the way.
  std::int64_t late = 0;     ///< Arrived after their set was processed, or matched none.
  std::int64_t torn = 0;
  int replacements = 0;              ///< Number of backgrounds learned since the start.
  double light = 1;                  ///< Brightness relative to the learned background.
  double nudged_px = 0;              ///< Shift of the picture relative to the learned background.
  bool is_blind = false;             ///< As in the last frame.
  CameraHealth health;               ///< Whether the other cameras agree.
  std::string waits_for;             ///< The camera that triggers it; empty: none known.
  std::vector<std::string> remarks;  ///< The driver's, from the last change of state.
  std::string time_source;           ///< Origin of capture times, as of the last change of state.
};

/// Whether it has been compared with the other cameras often enough.
inline bool IsCompared(const CameraStatus& camera) {
  return camera.health.moments >= HealthWatch::kFewestMoments;
}

}  // namespace mocap
