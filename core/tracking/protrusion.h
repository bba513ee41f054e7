// Beyond the paper: what reaches over the border of a silhouette.
#pragma once

#include <optional>

#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// How a ball of flesh sticks out of what one camera saw of the person.
struct Protrusion {
  Vector3 outward_W;  ///< Out of the silhouette where its border is nearest; unit length.
  double depth_mm;    ///< How far the ball reaches over the border.
};

/// Looks for the border's nearest ray, and tells how far a ball lies beyond it.
/// @return  empty where the ball lies inside, or where the border is too far off to tell.
std::optional<Protrusion> ProtrusionOf(const Outline& outline, const Vector3& center_W,
                                       double radius_mm);

}  // namespace mocap
