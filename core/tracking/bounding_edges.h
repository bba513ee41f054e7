// Beyond the paper: where along a grazing ray the person may be touched.
#pragma once

#include <span>
#include <vector>

#include "core/reconstruction/silhouette/outline.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// The stretch of a grazing ray that lies along the visual hull: somewhere on it the ray touches
/// the person (Cheung, Baker and Kanade 2003).
struct BoundingEdge {
  Vector3 from_W;
  Vector3 to_W;
  Vector3 outward_W;  ///< The person's normal where it is touched; unit length.
  /// The ray misses the hull: what it grazes was carved away, for some camera did not see it.
  bool misses_hull = false;
};

/// Cuts rays to bounding edges. Reuses its memory.
class BoundingEdgeFinder {
 public:
  /// Cuts each ray to its stretch along the voxels. A ray that misses them keeps its whole way
  /// through the person's box, because a limb may have been carved away that another camera did not
  /// see; but not where many more of its camera's rays miss than of the others', for then it is the
  /// camera that errs.
  void Find(const VoxelCloud& cloud, std::span<const Outline> outlines,
            const Eigen::AlignedBox3d& box_W, std::vector<BoundingEdge>& edges);

 private:
  struct Camera {
    int rays = 0, missing = 0;
    std::size_t cuts = 0;
  };

  Camera CutRays(const VoxelCloud& cloud, const Outline& outline, const Eigen::AlignedBox3d& box_W);
  double UsualMissingShare();

  std::vector<BoundingEdge> cuts_;
  std::vector<Camera> cameras_;
  std::vector<double> shares_;
};

}  // namespace mocap
