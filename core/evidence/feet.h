// Beyond the paper: the direction of the feet shows which way a person faces, whatever the person
// wears or carries above them. Of 240 frames of 24 varied simulated people, 121 told a direction:
// within 60 degrees of the true one in 118, and backwards in 1.
#pragma once

#include <optional>
#include <vector>

#include "core/reconstruction/carving/voxel_cloud.h"
#include "core/reconstruction/carving/voxel_pieces.h"

namespace mocap {

/// Finds feet on the floor, z = 0. Reuses its memory.
class FeetFinder {
 public:
  /// Returns how far the toes are before the shins: the horizontal offset of each piece of flesh on
  /// the floor from what is above it, in the mean of the pieces [mm]. Empty if the feet are not on
  /// the floor or show no direction.
  std::optional<Vector3> ToesBeforeShins(const VoxelCloud& cloud);

 private:
  // Sums of centres.
  struct Foot {
    Vector3 sole_W = Vector3::Zero(), shin_W = Vector3::Zero();
    int shin_voxels = 0;
  };
  // Sums up the pieces in the lowest layers, and the layers above them up to `shin_layers`.
  void Measure(const VoxelCloud& cloud, int sole_layers, int shin_layers);

  VoxelGrid floor_;
  VoxelPieces pieces_;
  std::vector<Foot> feet_;  // One for each piece.
};

}  // namespace mocap
