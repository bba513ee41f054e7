// Simple solids as voxels.
#pragma once

#include <functional>

#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap {

/// Fills every voxel of a box from `low` to `high` [mm] whose centre is in a solid.
inline VoxelGrid FillGrid(const Vector3& low, const Vector3& high, double voxel_mm,
                          const std::function<bool(const Vector3&)>& is_inside) {
  const Eigen::Vector3i first = (low / voxel_mm).array().floor().cast<int>();
  const Eigen::Vector3i last = (high / voxel_mm).array().ceil().cast<int>();
  VoxelGrid grid;
  grid.Reset(first, last - first, voxel_mm);
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int i = 0; i < grid.size().x(); ++i) {
        if (is_inside(grid.CenterOf(i, j, k))) grid.Set(i, j, k);
      }
    }
  }
  return grid;
}

}  // namespace mocap
