// Which part of the body each voxel belongs to, for whoever looks at voxels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// A body and where it is. Borrowed.
struct BodyInPlace {
  const BodyModel& body;
  const PoseState& pose;
};

/// Labels each voxel of a grid with the part (BodyPart) that is nearest of any body, in the order
/// of a scan of the grid along x, then y, then z; -1 where none is near.
void LabelVoxels(const VoxelGrid& grid, std::span<const BodyInPlace> bodies,
                 std::vector<std::int8_t>& labels);

}  // namespace mocap
