// Tells by the floor's looks how cameras' views of it belong together.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/board.h"

namespace mocap {

/// A camera's picture and where it sees the board.
struct FloorView {
  const Image<Bgr>* picture = nullptr;
  const Lens* lens = nullptr;
  RigidTransform X_CB;
};

/// Which views have the board turned by half a turn against the first.
struct FloorTurns {
  std::vector<bool> turned;
  double agreement = 0;  ///< Mean correlation of the floor over pairs of cameras.
  double runner_up = 0;  ///< The same for the next best way.
};

/// Seen from above, pictures of the floor around the board correlate when their turns are right.
FloorTurns MatchFloors(const std::vector<FloorView>& views, const Board& board);

}  // namespace mocap
