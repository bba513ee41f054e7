// Difference between two calibrations of the same cameras, in space.
#pragma once

#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Distances between the positions that two calibrations give to points in the room.
struct PlacementDifference {
  int points = 0;  ///< Points visible to at least two cameras.
  double mean_mm = 0, worst_mm = 0;
  Vector3 worst_at_W = Vector3::Zero();  ///< In the reference's frame.
  RigidTransform moved;                  ///< From the reference's frame: the motion that fits best.
  double left_mm = 0;                    ///< Mean distance that this motion leaves.
};

/// Projects points up to 1750 mm above the floor, in 3 x 3 m about the middle of the room, with the
/// reference, and triangulates them with the cameras. A difference of the world frames adds to the
/// distances; what is left without it is the difference in shape. Heads look ahead, up, down and to
/// the sides.
/// @throws SetupError  when a camera of the reference is missing.
PlacementDifference ComparePlacement(const std::vector<CameraCalibration>& cameras,
                                     const std::vector<CameraCalibration>& reference);

}  // namespace mocap
