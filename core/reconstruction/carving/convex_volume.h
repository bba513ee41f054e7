// §4: a convex volume, clipped by planes.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/geometry.h"

namespace mocap {

/// A convex polyhedron that starts as a box. Reuses its memory.
class ConvexVolume {
 public:
  /// Resets to a box.
  void Reset(const Eigen::AlignedBox3d& box);

  /// Keeps the part where normal · x <= offset.
  void Clip(const Vector3& normal, double offset);

  bool empty() const { return faces_.ends.empty(); }
  /// Axis-aligned bounding box of what is left.
  Eigen::AlignedBox3d Extent() const;

 private:
  // The corners, face after face.
  struct Faces {
    std::vector<Vector3> corners;
    std::vector<std::size_t> ends;
    void Clear() {
      corners.clear();
      ends.clear();
    }
  };
  struct Cut {
    Vector3 point;
    double angle = 0;
  };
  void SortCut(const Vector3& normal);

  Faces faces_, kept_;
  std::vector<Cut> cut_;
};

}  // namespace mocap
