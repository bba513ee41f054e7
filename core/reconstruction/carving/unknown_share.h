// Beyond the paper: how much of the people one camera cannot tell from the empty studio.
#pragma once

#include <optional>

#include "core/reconstruction/carving/carving_view.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Returns the share of unknown pixels where a camera shows a hull, 0 to 1. Voxels count, by their
/// centres, so that it does not depend on the camera's resolution. Empty if the camera shows none.
/// @param hull  of people; carved with the unknown pixels of all cameras.
std::optional<double> UnknownShare(const VoxelGrid& hull, const CarvingView& view);

}  // namespace mocap
