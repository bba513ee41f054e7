// Furniture in the studio.
#pragma once

#include "core/geometry.h"
#include "core/image.h"

namespace mocap::simulation {

/// An upright block.
struct Block {
  Vector3 center_W = Vector3::Zero();
  Vector3 half_mm = Vector3::Zero();
  double yaw = 0;
  Bgr color;
  bool grained = false;  ///< Wood instead of paint.
};

}  // namespace mocap::simulation
