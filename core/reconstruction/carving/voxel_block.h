// Visits, copies and counts voxels of a grid.
#pragma once

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>

#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Visits the voxels (i, j, k) of a grid, row by row.
template <typename Visit>
void ForEachVoxel(const VoxelGrid& grid, const Visit& visit) {
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      const std::uint64_t* const row = grid.row(j, k);
      for (int word = 0; word < grid.words_per_row(); ++word)
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
          visit(word * 64 + std::countr_zero(bits), j, k);
    }
  }
}

/// Copies the cells of a grid from the lowest to the highest, inclusive; reuses the memory of
/// `block`. Without cells, the block has no voxels. @pre they lie within the grid.
void CopyBlock(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells, VoxelGrid& block);

/// Returns the voxels of a grid within a box [mm, world]: the grid itself, if all of it is within.
/// @param block  memory for the result.
const VoxelGrid& VoxelsWithin(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_W,
                              VoxelGrid& block);

/// Returns the cells of a grid that a box touches [mm, world]; empty if there are none.
Eigen::AlignedBox3i CellsWithin(const VoxelGrid& grid, const Eigen::AlignedBox3d& box_W);

/// Returns the volume of a grid's voxels outside a block of its cells [litres].
double LitresBeside(const VoxelGrid& grid, const Eigen::AlignedBox3i& cells);

}  // namespace mocap
