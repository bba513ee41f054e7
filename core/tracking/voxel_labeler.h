// §6.2: which part of the body each voxel belongs to, and the 23 points that follow from it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/body/body_model.h"
#include "core/tracking/template_fit.h"
#include "core/tracking/voxel_cloud.h"

namespace mocap {

/// What labelling makes of one frame.
struct LabeledVoxels {
  static constexpr std::int8_t kNone = -1;
  std::vector<std::int8_t> part;  ///< Of each voxel of the cloud: a BodyPart or kNone.
  /// p_WQ of Table 2 [mm]; a point that was not seen is absent, never invented.
  std::array<std::optional<Vector3>, kPointCount> points_W;
};

/// Labels voxels: head and torso by shape, limbs by distance from where the new torso would carry
/// them. Fig. 8.
///
/// Thread-bound; reuses its memory.
class VoxelLabeler {
 public:
  /// @param predicted  the pose expected for this frame.
  const LabeledVoxels& Label(const VoxelCloud& cloud, const BodyModel& body,
                             const PoseState& predicted);

 private:
  bool LabelHead(const Vector3& predicted_W);
  PoseState LabelTorso(const PoseState& predicted);
  void LabelLimbs(const PoseState& moved);
  void SplitLimb(int limb, const BodyPoints& moved_W);
  void MeasureCentroids();
  Vector3 FarEnd(const std::vector<int>& voxels, const Vector3& from_W) const;

  const VoxelCloud* cloud_ = nullptr;
  const BodyModel* body_ = nullptr;
  LabeledVoxels labeled_;
  HeadFit head_;
  std::vector<int> rest_;
  std::array<std::vector<int>, 4> limbs_;
};

}  // namespace mocap
