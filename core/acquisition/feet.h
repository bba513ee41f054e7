// Beyond the paper: the direction of the feet shows which way a person faces, whatever the person
// wears or carries above them.
#pragma once

#include <optional>
#include <vector>

#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// Finds feet on the floor. Reuses its memory.
class FeetFinder {
 public:
  /// Returns how far the toes are before the shins: the horizontal offset of each piece of flesh on
  /// the floor from what is above it, in the mean of the pieces [mm]. Empty if the feet are not on
  /// the floor or show no direction.
  std::optional<Vector3> ToesBeforeShins(const VoxelCloud& cloud);

 private:
  // A piece of flesh on the floor: its voxels' indices, and their columns of cells.
  void CollectPiece(const VoxelCloud& cloud, int first);
  std::optional<Vector3> OffsetOfPiece(const VoxelCloud& cloud);

  std::vector<char> is_taken_;  // For each voxel on the floor.
  std::vector<int> piece_;
  std::vector<Eigen::Vector2i> columns_;
};

}  // namespace mocap
