// The part of a picture that a pose network looks at.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/body/body_shape.h"
#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// A rectangle of a picture, turned by quarter turns so that people in it are upright. It may reach
/// beyond the picture.
struct PictureRegion {
  Vector2 middle_px = Vector2::Zero();
  double width_px = 0;   ///< Across the upright person.
  double height_px = 0;  ///< Along the upright person.
  int turns = 0;         ///< Quarter turns to the right that make the picture upright: 0 to 3.
};

/// The turns that make a picture upright in which up is that direction.
int TurnsFor(const Vector2& up);

/// Takes points of a crop to the picture. Pixel centres lie at integers in both.
struct CropMap {
  Eigen::Matrix2d turn_and_scale = Eigen::Matrix2d::Identity();
  Vector2 origin_px = Vector2::Zero();  ///< Of the crop, in the picture.

  Vector2 operator*(const Vector2& crop_px) const { return turn_and_scale * crop_px + origin_px; }
};

/// Returns the map of a crop of this size that shows the region.
CropMap MapOf(const PictureRegion& region, int crop_width_px, int crop_height_px);

/// How a camera sees a body.
struct SeenBox {
  PictureRegion box;      ///< Around what the lens can show of it.
  double in_picture = 0;  ///< Share of the body that is in the picture, 0 to 1.
};

/// Finds the box of a body in a camera's picture. Empty: no part of it is before the lens.
std::optional<SeenBox> SeeBody(std::span<const PosedCapsule> capsules,
                               const CameraCalibration& camera, const RigidTransform& X_CW);

/// Makes a box as wide and high as a network's input wants, with room for errors: 1.25 times the
/// side that decides.
/// @param aspect  width / height of the input.
PictureRegion RegionAround(const PictureRegion& box, double aspect);

}  // namespace mocap
