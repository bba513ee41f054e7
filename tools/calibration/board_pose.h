// Where a board lies as one camera sees it.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"

namespace mocap {

/// A pose that explains what was seen.
struct BoardPose {
  RigidTransform X_CB;
  double rms_px = 0;
};

/// Finds the board's pose; a plane seen from far away has two that are nearly as good: best first.
/// Empty when the lens does not show the corners or no pose puts the board before the camera.
std::vector<BoardPose> FindBoardPoses(const Lens& lens, const Board& board,
                                      const BoardCorners& corners);

/// Root mean square distance of corners from where a pose puts them; infinite when one is not seen.
double PoseRmsPx(const Lens& lens, const Board& board, const BoardCorners& corners,
                 const RigidTransform& X_CB);

}  // namespace mocap
