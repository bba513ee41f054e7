// Beyond the paper: what reaches over the border of a silhouette.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// How a ball of flesh sticks out of what one camera saw of the person.
struct Protrusion {
  Vector3 outward_W;  ///< Out of the silhouette where its border is nearest; unit length.
  double depth_mm;    ///< How far the ball reaches over the border.
};

/// The border of one silhouette, to hold many balls against. Which of its rays is nearest is found
/// in single precision, for a block of rays at a time.
class SilhouetteBorder {
 public:
  /// Takes what a camera saw; `outline` is borrowed until the next.
  void SetOutline(const Outline& outline);

  /// Looks for the border's nearest ray, and tells how far a ball lies beyond it.
  /// @return  empty where the ball lies inside, or where the border is too far off to tell.
  std::optional<Protrusion> ProtrusionOf(const Vector3& center_W, double radius_mm) const;

  static constexpr int kRays = 16;
  /// Directions of neighbouring rays; zero beyond the last.
  struct Block {
    alignas(64) std::array<float, kRays> x{}, y{}, z{};
  };

 private:
  const Outline* outline_ = nullptr;
  std::vector<Block> blocks_;
};

}  // namespace mocap
