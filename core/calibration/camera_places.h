// §4: whether the extrinsics of cameras are plausible, without pictures.
#pragma once

#include <span>
#include <vector>

#include "core/calibration/finding.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Two cameras nearer than this are one.
inline constexpr double kNearestCameras_mm = 50;

/// Checks rotations, heights above the floor and distances between the cameras.
/// @param has_floor  whether z = 0 is meant to be the floor.
/// @return  the worst first, what concerns several cameras once; empty if nothing is wrong.
std::vector<Finding> CheckPlaces(std::span<const CameraCalibration> cameras, bool has_floor);

}  // namespace mocap
