// Hints on what is still missing while a board is shown to live cameras.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/detections.h"

namespace mocap {

/// Progress of one camera.
struct CameraHint {
  std::string camera;
  int views = 0;
  double covered = 0;   ///< Share of the picture's cells that showed the board.
  std::string missing;  ///< What to do next, for people; empty: it has seen enough.
};

/// Returns what each camera still lacks: views, parts of the picture, or views shared with other
/// cameras. Without any view, what it shows instead of the board, if that is known.
std::vector<CameraHint> HintsFor(const BoardDetections& detections);

}  // namespace mocap
