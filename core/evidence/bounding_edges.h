// Beyond the paper: the part of a grazing ray where it may touch the person.
#pragma once

#include <span>
#include <vector>

#include "core/body/segment_matcher.h"
#include "core/reconstruction/carving/voxel_cloud.h"
#include "core/reconstruction/silhouette/outline.h"

namespace mocap {

/// The part of a grazing ray along the visual hull. Somewhere on it the ray touches the person
/// (Cheung, Baker and Kanade 2003), with this normal.
struct BoundingEdge : OrientedSegment {
  /// The ray misses the hull: another camera did not see what it grazes, so it was carved away.
  bool misses_hull = false;
  SpreadRank rank = 0;  ///< Of the ray.
  int camera = 0;       ///< Whose outline has the ray.
};

/// Cuts each ray to its part along the voxels. A ray that misses them keeps its whole length in the
/// person's box, because another camera may have missed a limb, so that it was carved away.
/// @param outlines  one per camera.
/// @param edges     overwritten; their memory is reused.
void FindBoundingEdges(const VoxelCloud& cloud, std::span<const Outline> outlines,
                       const Eigen::AlignedBox3d& box_W, std::vector<BoundingEdge>& edges);

}  // namespace mocap
