// §4: whether the extrinsics of cameras are plausible, without pictures.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/calibration/finding.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Two cameras nearer than this are one.
inline constexpr double kNearestCameras_mm = 50;

/// Lists cameras: "cam2", "cam2 and cam5", "cam1, cam2 and cam5".
std::string NamesOf(const std::vector<std::size_t>& indices,
                    std::span<const CameraCalibration> cameras);

/// Checks rotations, heights above the floor and distances between the cameras.
/// @param has_floor  whether z = 0 is meant to be the floor.
/// @return  the worst first, what concerns several cameras once; empty if nothing is wrong.
std::vector<Finding> CheckPlaces(std::span<const CameraCalibration> cameras, bool has_floor);

}  // namespace mocap
