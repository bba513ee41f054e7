// Cutting a block of cells out of a voxel grid.
#pragma once

#include <Eigen/Geometry>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Copies the cells of a grid from the lowest to the highest, both included; reuses the memory of
/// `block`. @pre they lie within the grid; without any, the block has no voxels.
void CopyBlock(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells, VoxelGrid& block);

/// The cells of a grid that a box touches [mm, world]; empty without any.
Eigen::AlignedBox3i CellsWithin(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_W);

/// Flesh of a grid that lies outside of a block of its cells [litres].
double LitresBeside(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells);

}  // namespace mocap
