// Pose of a board seen by one camera.
#pragma once

#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"

namespace mocap {

/// A pose consistent with the observation.
struct BoardPose {
  RigidTransform X_CB;
  double rms_px = 0;
};

/// Finds the board's pose. A distant plane has two that fit nearly equally: best first. Empty if a
/// corner is outside the lens's field or no pose puts the board in front of the camera.
std::vector<BoardPose> FindBoardPoses(const Lens& lens, const Board& board,
                                      const BoardCorners& corners);

/// Root mean square reprojection error of a pose; infinite if a corner is not visible.
double PoseRmsPx(const Lens& lens, const Board& board, const BoardCorners& corners,
                 const RigidTransform& X_CB);

}  // namespace mocap
