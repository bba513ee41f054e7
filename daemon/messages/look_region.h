// The region around a person in a picture.
#pragma once

#include <optional>
#include <span>

#include "core/body/body_shape.h"
#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// A square in a camera's picture. It may reach outside of it.
struct LookRegion {
  int left_px = 0;
  int top_px = 0;
  int side_px = 0;
  Vector2 up = Vector2::Zero();  ///< Unit vector in the picture that is up in the world there.
};

/// Finds the square around a posed body, with a margin.
/// @param X_CW  of the camera, at that moment.
/// @return  empty: the picture does not show the body.
std::optional<LookRegion> RegionAround(std::span<const PosedCapsule> capsules,
                                       const CameraCalibration& camera, const RigidTransform& X_CW);

/// Cuts a region out of a picture; black outside of it.
/// @param cut  overwritten; its memory is reused.
void CutRegion(ImageView<const Bgr> picture, const LookRegion& region, Image<Bgr>& cut);

}  // namespace mocap
