// Cameras posed by one board that lies still on the floor.
#pragma once

#include <vector>

#include "core/image.h"
#include "tools/calibration/extrinsics.h"

namespace mocap {

/// Gives each camera's pose from the one board that all see; the world is the board's plane.
///
/// A board that looks the same turned is told apart by the floor around it: of the ways to turn it,
/// the one is taken in which the cameras' pictures, seen from straight above, agree.
/// @param pictures  one a camera, for that.
/// @throws SetupError  naming the camera that sees no board, or when the turns cannot be told
/// apart.
StudioFit FitToStillBoard(const BoardDetections& still,
                          const std::vector<CameraCalibration>& lenses,
                          const std::vector<Image<Bgr>>& pictures, double thickness_mm);

}  // namespace mocap
