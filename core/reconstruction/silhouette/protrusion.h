// Beyond the paper: flesh outside the border of a silhouette.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/kernels/nearest.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// How far a ball of flesh extends outside a silhouette of one camera.
struct Protrusion {
  Vector3 outward_W;  ///< Outward direction at the nearest border of the silhouette; unit length.
  double depth_mm;    ///< Distance that the ball extends beyond the border.
};

/// The border of one silhouette, for comparison with many balls. The nearest ray is found in single
/// precision, for a block of rays at a time.
class SilhouetteBorder {
 public:
  /// Sets the outline of a camera; `outline` is borrowed until the next call.
  void SetOutline(const Outline& outline);

  /// Finds the border's nearest ray and measures how far a ball lies beyond it.
  /// @return  empty if the ball lies inside, or if the border is too far away to tell.
  std::optional<Protrusion> ProtrusionOf(const Vector3& center_W, double radius_mm) const;

 private:
  const Outline* outline_ = nullptr;
  std::vector<kernels::RayBlock> blocks_;
};

}  // namespace mocap
