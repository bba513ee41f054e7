// §4: whether the extrinsics of cameras are plausible, without pictures.
#pragma once

#include <span>
#include <vector>

#include "core/calibration/finding.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Checks rotations, heights above the floor and distances between the cameras.
/// @param has_floor  whether z = 0 is meant to be the floor.
/// @return  the worst first; empty if nothing is wrong.
std::vector<Finding> CheckPlaces(std::span<const CameraCalibration> cameras, bool has_floor);

}  // namespace mocap
