// Tells what is still missing while a board is shown to live cameras.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/detections.h"

namespace mocap {

/// How far one camera is.
struct CameraHint {
  std::string camera;
  int views = 0;
  double covered = 0;   ///< Share of the picture's parts that showed the board.
  std::string missing;  ///< What to do next, for people; empty: it has seen enough.
};

/// Tells for each camera what it has not seen yet: views, parts of the picture, and views that it
/// shares with the other cameras.
std::vector<CameraHint> HintsFor(const BoardDetections& detections);

}  // namespace mocap
