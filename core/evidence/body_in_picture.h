// Where a camera shows a body.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/body/body_shape.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// How a camera sees a body.
struct BodyInPicture {
  Eigen::AlignedBox2d box_px;  ///< Around what the lens can show of it, also beyond the picture.
  double share = 0;            ///< Of the body that is in the picture, 0 to 1.
  /// Direction in the picture that is up in the world there; unit vector. Empty: not known.
  std::optional<Vector2> up;
};

/// Finds a posed body in a camera's picture.
/// @param X_CW  of the camera, at that moment.
/// @return  empty: no part of it is before the lens.
std::optional<BodyInPicture> FindInPicture(std::span<const PosedCapsule> capsules,
                                           const CameraCalibration& camera,
                                           const RigidTransform& X_CW);

}  // namespace mocap
