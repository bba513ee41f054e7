// §4, beyond the paper: what a camera shows of the people at a moment, without where they are.
#pragma once

#include <optional>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// A person of 1.7 m where the picture shows 14 m: limbs of smaller ones have too few pixels.
inline constexpr double kLeastPersonShare = 0.12;

/// The convex hull of a silhouette. It touches every line that touches the silhouette from outside,
/// which is all that the epipolar tangents of two views compare.
struct SeenShape {
  /// Corners, between the pixels' centres; empty: nobody is seen.
  std::vector<Vector2> rim_px;
  bool is_cut = false;      ///< Reaches the edge of the picture: somebody may go on beyond.
  double height_share = 0;  ///< Of the picture's height.
  RigidTransform X_CW;      ///< The camera's pose at this moment.
};

/// One moment, with an entry for each camera; empty where it delivered no picture.
using SeenMoment = std::vector<std::optional<SeenShape>>;

/// Finds the shape of everything in a silhouette.
SeenShape ShapeOf(const Silhouette& silhouette, const RigidTransform& X_CW);

}  // namespace mocap
