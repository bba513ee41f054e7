// Whether two calibrations are one.
#pragma once

#include <span>
#include <string>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Names the first difference of a calibration from another one: `has no camera "cam1"`, or `has
/// camera "cam1" with other extrinsics or intrinsics`. Empty: every camera of the other one is the
/// same.
std::string DifferenceFrom(std::span<const CameraCalibration> other,
                           std::span<const CameraCalibration> cameras);

}  // namespace mocap
