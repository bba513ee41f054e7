// §4: cameras on pan-tilt heads: aiming a head at a point.
#pragma once

#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// Turns a pan-tilt head so that a point comes to the centre of the picture.
///
/// Newton's method on the angles at which the camera sees the point. The head's axes are nearly
/// those of the picture, so it converges in a few steps.
///
/// @param camera  with a pan-tilt head.
/// @param p_WQ    the point [mm].
/// @param from    present angles of the head; the solution near them is found.
/// @return        the encoder readings then. For a point on an axis they stay about the same.
PanTiltAngles AimAt(const CameraCalibration& camera, const Vector3& p_WQ,
                    const PanTiltAngles& from = {});

}  // namespace mocap
