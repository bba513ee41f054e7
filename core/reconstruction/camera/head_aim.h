// §4: cameras on heads. Where a head has to look to see a point.
#pragma once

#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Turns a head so that a point comes to the middle of the lens.
///
/// Newton's method on the angles at which the camera sees the point: the head's axes are nearly
/// those of the picture, so that it settles in a few steps.
///
/// @param camera  with a head.
/// @param p_WQ    the point [mm].
/// @param from    where the head points now; of several directions the one near to it is found.
/// @return        what the head's encoders read then. A point on an axis leaves them about where
///                they are.
PanTiltAngles AimAt(const CameraCalibration& camera, const Vector3& p_WQ,
                    const PanTiltAngles& from = {});

}  // namespace mocap
