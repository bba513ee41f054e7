// Records a camera's view of the empty studio.
#pragma once

#include <filesystem>
#include <vector>

#include "config/open_live.h"

namespace mocap {

/// Outcome of a recording.
struct BackgroundRecord {
  int frames = 0;
  /// Share of the picture that differed clearly from the first frame; maximum over all frames.
  double changed = 0;
};

/// Records a camera's pictures into NAME.mkv in a folder. Starts the camera, lets it settle for a
/// second, and stops it. A fixed camera is recorded for the given time. A camera on a head scans
/// its whole range in steps of less than half a picture; the directions go to NAME.csv.
/// @throws SetupError  when the camera cannot be used, or its range would take hours.
/// @throws std::runtime_error  when it delivers nothing for seconds, its head does not turn, or
/// nothing can be written.
BackgroundRecord RecordBackground(LiveCamera& camera, const std::filesystem::path& folder,
                                  double seconds);

/// Records a fixed camera's pictures for some time, at kOccupiedFps or less. @throws likewise.
void RecordOccupied(LiveCamera& camera, const std::filesystem::path& folder, double seconds);

/// Returns the directions of a scan, in an order that keeps steps small.
/// @pre  the camera is calibrated and its head was started.
std::vector<PanTiltAngles> SweepDirections(const LiveCamera& camera);

}  // namespace mocap
