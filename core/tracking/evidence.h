// The evidence of one frame set: voxels and outlines of the person.
#pragma once

#include <span>
#include <vector>

#include "core/tracking/bounding_edges.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// The person as voxels and as the outlines that they were carved by. Reuses its memory.
struct Evidence {
  VoxelCloud cloud;
  std::vector<Outline> outlines;  ///< One a camera; empty of those that are not in.
  std::vector<BoundingEdge> edges;
  std::vector<BoundingEdge> missing;  ///< Memory for FindBoundingEdges.

  void Gather(const VoxelGrid& grid, std::span<const Outline> seen) {
    cloud.Build(grid);
    outlines.assign(seen.begin(), seen.end());
    FindBoundingEdges(cloud, outlines, edges, missing);
  }
};

}  // namespace mocap
