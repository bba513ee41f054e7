// How one camera does.
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
  std::string node;  ///< Where its driver is; empty: here.
  CameraState state = CameraState::kStarting;
  std::int64_t frames = 0;
  std::int64_t dropped = 0;  ///< Gaps in the camera's count, and frames let go on the way.
  std::int64_t late = 0;     ///< Came after their set had gone, or found none.
  std::int64_t torn = 0;
  int replacements = 0;              ///< How often the background was learned since the start.
  double light = 1;                  ///< Brightness, over that of the empty studio as learned.
  double nudged_px = 0;              ///< How far the picture lies from where it was learned.
  bool is_blind = false;             ///< As the last frame's.
  CameraHealth health;               ///< Whether the other cameras agree.
  std::string waits_for;             ///< The camera that triggers it; empty: none that is known.
  std::vector<std::string> remarks;  ///< Of the driver, when the state last changed.
  std::string time_source;           ///< Where capture times come from, as the driver had it then.
};

}  // namespace mocap
