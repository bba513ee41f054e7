// Which part of the body each voxel belongs to, for whoever looks at voxels.
#pragma once

#include <cstdint>
#include <vector>

#include "core/body/body_model.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Labels each voxel of a grid with the part (BodyPart) of the posed body that is nearest, in the
/// order of a scan of the grid along x, then y, then z; -1 where none is near.
void LabelVoxels(const VoxelGrid& grid, const BodyModel& body, const PoseState& pose,
                 std::vector<std::int8_t>& labels);

}  // namespace mocap
