// §4: a convex piece of space, cut by planes.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// A convex polyhedron that starts as a box.
class ConvexVolume {
 public:
  explicit ConvexVolume(const Eigen::AlignedBox3d& box);

  /// Keeps the part where normal · x <= offset.
  void Clip(const Vector3& normal, double offset);

  bool empty() const { return faces_.empty(); }
  /// The smallest upright box around what is left.
  Eigen::AlignedBox3d Extent() const;

 private:
  using Face = std::vector<Vector3>;
  std::vector<Face> faces_;
};

}  // namespace mocap
