// Records a calibration board with live cameras, as footage.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "config/open_live.h"
#include "tools/calibration/board_hints.h"

namespace mocap {

struct BoardRecordingOptions {
  Board board;
  std::filesystem::path folder;  ///< Created; one grey video and one table per camera.
  double frames_per_second = 5;
  double most_seconds = 180;
};

/// Called after each search in all cameras, with what is still missing. @return  true to stop.
using HintListener = std::function<bool(const std::vector<CameraHint>&)>;

/// Checks that a folder to record into does not exist. @throws SetupError
void RequireNew(const std::filesystem::path& folder);

/// Records until the listener stops it, the time is over or the cameras end. All cameras keep
/// frames of the same times. The search for the board does not delay the recording, and the
/// calibration can be computed again from what was recorded. That stays, also when something is
/// thrown.
/// @throws SetupError          when the folder exists, or a camera cannot be used.
/// @throws std::runtime_error  when a camera delivers nothing, or something cannot be written.
void RecordBoard(std::vector<LiveCamera>& cameras, const BoardRecordingOptions& options,
                 const HintListener& listener);

}  // namespace mocap
