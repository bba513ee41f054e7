// The cameras of a studio as the page draws them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// JSON of a studio: each camera's name, picture, position, rotation, and the corners of what it
/// sees, a metre before it.
/// @param X_CW  where each camera stands; as many as there are cameras.
std::string StudioJson(const std::string& name, std::span<const CameraCalibration> cameras,
                       std::span<const RigidTransform> X_CW);

}  // namespace mocap
