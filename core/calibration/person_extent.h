// §4, beyond the paper: how high a person reaches, by what all cameras' cones share, without
// voxels, so that it holds for any unit of length and on either side of the floor.
#pragma once

#include <cstddef>
#include <span>

#include "core/calibration/seen_shape.h"

namespace mocap {

/// How far a person reaches in height, in the calibration's frame and unit of length.
struct PersonExtent {
  int moments = 0;                       ///< Those in which it could be measured.
  double lowest_mm = 0, highest_mm = 0;  ///< Soles and crown; medians over these moments.

  bool is_below_floor() const { return lowest_mm + highest_mm < 0; }
};

/// Measures one upright person from the rims of the shapes that are whole in their pictures.
/// @param cameras  of the moments' entries, in their order.
/// @param of  indices of the cameras to use.
PersonExtent MeasureExtent(std::span<const CameraCalibration> cameras,
                           std::span<const SeenMoment> moments, std::span<const std::size_t> of);

}  // namespace mocap
