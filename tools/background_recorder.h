// Records what one camera sees of the empty studio.
#pragma once

#include <filesystem>
#include <vector>

#include "config/open_live.h"

namespace mocap {

/// Outcome of a recording.
struct BackgroundRecord {
  int frames = 0;
  /// Share of the picture that differed clearly from the first frame, in the worst one.
  double changed = 0;
};

/// Records what a camera sees into NAME.mkv in a folder. Starts the camera, lets it settle for a
/// second, and stops it. A camera that stands still is watched for the time given; one on a head
/// looks in all directions that it may, less than half a picture apart, and these are written to
/// NAME.csv.
/// @throws SetupError  when the camera cannot be used, or may turn so far that it would take hours.
/// @throws std::runtime_error  when it delivers nothing for seconds, its head does not turn, or
/// nothing can be written.
BackgroundRecord RecordBackground(LiveCamera& camera, const std::filesystem::path& folder,
                                  double seconds);

/// Gives the directions of a sweep, each next to the one before.
/// @pre  the camera is calibrated and has a head that was started.
std::vector<PanTiltAngles> SweepDirections(const LiveCamera& camera);

}  // namespace mocap
