// Records what live cameras see of a board, as footage for calibration.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "config/open_live.h"
#include "tools/calibration/board_hints.h"

namespace mocap {

struct BoardRecordingOptions {
  Board board;
  std::filesystem::path folder;  ///< Made; one grey video and one table a camera.
  double frames_per_second = 5;
  double most_seconds = 180;
};

/// Told what is still missing, after each look at all cameras. @return  true to stop.
using HintListener = std::function<bool(const std::vector<CameraHint>&)>;

/// Records until the listener stops it, the time is over or the cameras end. All cameras keep
/// frames of the same moments; looking for the board does not hold the recording up.
/// @throws SetupError          when the folder exists, or a camera cannot be used.
/// @throws std::runtime_error  when a camera delivers nothing, or something cannot be written.
void RecordBoard(std::vector<LiveCamera>& cameras, const BoardRecordingOptions& options,
                 const HintListener& listener);

}  // namespace mocap
