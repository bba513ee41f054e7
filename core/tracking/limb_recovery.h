// §6.2: finds a limb again that has been lost, by the shape of the voxels and not by their distance
// from the prediction.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/tracking/surface_fit.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// Tries each arm and leg in other stances when much of the surface is explained by no part. After
/// a search in vain it rests for some frames.
class LimbRecovery {
 public:
  LimbRecovery();

  /// Looks for a pose that explains clearly more of the voxels than `pose` does, changing one limb.
  std::optional<PoseState> Recover(const BodyModel& body, const VoxelCloud& cloud,
                                   const PoseState& pose);

 private:
  SurfaceFit fit_;
  int resting_ = 0;  ///< Frames to go until the next search.
};

}  // namespace mocap
