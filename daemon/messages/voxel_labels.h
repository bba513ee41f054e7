// Assigns voxels to body parts, for viewers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// A body with its pose. Borrowed.
struct BodyInPlace {
  const BodyModel& body;
  const PoseState& pose;
};

/// Labels each voxel of a grid with the nearest part (BodyPart) of any body, in scan order: x, then
/// y, then z; -1 if none is near.
void LabelForViewers(const VoxelGrid& grid, std::span<const BodyInPlace> bodies,
                     std::vector<std::int8_t>& labels);

}  // namespace mocap
