// §4: from silhouettes to voxels.
#pragma once

#include <optional>
#include <span>

#include "core/reconstruction/camera_model.h"
#include "core/reconstruction/sensor_plane_table.h"
#include "core/reconstruction/silhouette.h"
#include "core/reconstruction/voxel_grid.h"

namespace mocap {

/// What one camera contributes to a set: its outline and where it stood at that moment. Borrowed
/// for the call.
struct CarvingView {
  const SensorPlaneTable* table = nullptr;
  const Silhouette* silhouette = nullptr;
  RigidTransform X_CW;
};

struct CarvingOptions {
  double voxel_mm = 25;
};

/// Carves the person out of the volume of interest that the silhouettes span.
///
/// A voxel is sampled uniformly and kept when the majority of its samples agrees with all
/// silhouettes; a camera that cannot see a place does not carve it. Mikić et al. 2003, §4.
/// Thread-bound; reuses its memory.
class Carver {
 public:
  explicit Carver(const CarvingOptions& options) : options_(options) {}

  /// Carves one set. With nothing to see the grid has no voxels.
  /// @post the result does not depend on how the work is divided.
  void Carve(std::span<const CarvingView> views, VoxelGrid& grid);

 private:
  CarvingOptions options_;
};

}  // namespace mocap
