// Copies a block of cells from a voxel grid.
#pragma once

#include <Eigen/Geometry>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Copies the cells of a grid from the lowest to the highest, inclusive; reuses the memory of
/// `block`. Without cells, the block has no voxels. @pre they lie within the grid.
void CopyBlock(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells, VoxelGrid& block);

/// Returns the cells of a grid that a box touches [mm, world]; empty if there are none.
Eigen::AlignedBox3i CellsWithin(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_W);

/// Returns the volume of a grid's voxels outside a block of its cells [litres].
double LitresBeside(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells);

}  // namespace mocap
