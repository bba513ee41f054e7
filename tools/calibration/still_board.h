// Extrinsics from one board that lies still on the floor.
#pragma once

#include <vector>

#include "core/image.h"
#include "tools/calibration/extrinsics.h"

namespace mocap {

/// Computes each camera's pose from one board that all see; the world is the board's plane.
///
/// The floor resolves a board that looks the same turned: the chosen turns make the cameras'
/// pictures agree when seen from above.
/// @param pictures  one per camera, for this.
/// @throws SetupError  naming the camera that sees no board, or when the turns cannot be resolved.
StudioFit FitToStillBoard(const BoardDetections& still,
                          const std::vector<CameraCalibration>& lenses,
                          const std::vector<Image<Bgr>>& pictures, double thickness_mm);

}  // namespace mocap
