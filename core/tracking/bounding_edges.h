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
};

/// Cuts each ray to its stretch along the voxels. A ray that misses them keeps its whole way
/// through their box, because a limb may have been carved away that another camera did not see; but
/// not if a third of its camera's rays miss, for then it is the camera that errs.
/// @param missing  memory to work with.
void FindBoundingEdges(const VoxelCloud& cloud, std::span<const Outline> outlines,
                       std::vector<BoundingEdge>& edges, std::vector<BoundingEdge>& missing);

}  // namespace mocap
