// JSON of a studio's cameras, for the page.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// JSON of a studio: each camera's name, picture size, position, rotation, and the corners of its
/// field of view at one metre.
/// @param X_CW  pose of each camera; same size as `cameras`.
std::string StudioJson(const std::string& name, std::span<const CameraCalibration> cameras,
                       std::span<const RigidTransform> X_CW);

}  // namespace mocap
