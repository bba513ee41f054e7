// Resolves the board's orientation between cameras by the appearance of the floor.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"

namespace mocap {

/// A camera's picture with its detection of the board.
struct FloorView {
  const Image<Bgr>* picture = nullptr;
  const Lens* lens = nullptr;
  RigidTransform X_CB;
};

/// For each view, whether its board is rotated by half a turn against the first.
struct FloorTurns {
  std::vector<bool> turned;
  double agreement = 0;  ///< Mean correlation of the floor over pairs of cameras.
  double runner_up = 0;  ///< The same for the second best choice.
};

/// Finds the turns with the best correlation of the floor around the board, seen from above.
FloorTurns MatchFloors(const std::vector<FloorView>& views, const Board& board);

}  // namespace mocap
