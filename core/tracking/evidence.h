// What one frame set shows of the person.
#pragma once

#include <span>
#include <vector>

#include "core/tracking/bounding_edges.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// The person as voxels and as the outlines that they were carved by. Reuses its memory.
struct Evidence {
  VoxelCloud cloud;
  std::vector<BoundingEdge> edges;
  std::vector<BoundingEdge> missing;  ///< Memory for FindBoundingEdges.

  void Gather(const VoxelGrid& grid, std::span<const Outline> outlines) {
    cloud.Build(grid);
    FindBoundingEdges(cloud, outlines, edges, missing);
  }
};

}  // namespace mocap
