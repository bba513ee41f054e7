// Records what one camera sees of the empty studio.
#pragma once

#include <filesystem>
#include <string>

#include "config/open_live.h"

namespace mocap {

/// How much of the picture changes between frames, at the most that a still room may.
inline constexpr double kMostChange = 0.004;

/// What became of a recording.
struct BackgroundRecord {
  int frames = 0;
  /// Share of the picture that differed clearly from the first frame, in the worst one.
  double changed = 0;
};

/// Records some dozens of frames, spread over the time given, into `file`. Starts the camera, lets
/// it settle for a second, and stops it.
/// @throws SetupError  when the camera cannot be used.
/// @throws std::runtime_error  when it delivers nothing for seconds, or nothing can be written.
BackgroundRecord RecordBackground(LiveCamera& camera, const std::filesystem::path& file,
                                  double seconds);

}  // namespace mocap
