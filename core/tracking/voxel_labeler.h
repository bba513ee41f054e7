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
  /// p_WQ of Table 2 [mm]; a point of a part that was not seen is absent, never invented. Joints,
  /// which voxels do not show, are where the pose has them that labels the voxels.
  std::array<std::optional<Vector3>, kPointCount> points_W;
};

/// Labels voxels: head and torso by shape, limbs by distance from where a pose puts them. Fig. 8.
///
/// Thread-bound; reuses its memory.
class VoxelLabeler {
 public:
  /// @param pose  near to this frame's: the paper predicts it and moves it along with head and
  ///              torso; here it was drawn to the surface.
  const LabeledVoxels& Label(const VoxelCloud& cloud, const BodyModel& body, const PoseState& pose);

 private:
  void LabelHead();
  void LabelTorso();
  void PoseLimbs();
  void LabelLimbs();
  void MeasureLimb(int limb);
  void MeasureCentroids();

  Vector3 At(Point point) const { return points_W_.col(static_cast<int>(point)); }
  void Measure(Point point, const Vector3& p_W) {
    labeled_.points_W[static_cast<int>(point)] = p_W;
  }
  bool IsEnough(std::size_t voxels) const;
  Vector3 FarEnd(const std::vector<int>& voxels, const Vector3& from_W) const;

  const VoxelCloud* cloud_ = nullptr;
  const BodyModel* body_ = nullptr;
  BodyPoints points_W_;  ///< Of the body at the pose.
  Vector3 neck_W_;
  LabeledVoxels labeled_;
  std::vector<PosedCapsule> capsules_;      ///< Of the limbs' parts.
  std::vector<int> rest_;                   ///< Voxels that are not the head's.
  std::array<std::vector<int>, 4> lowers_;  ///< Voxels of lower arms and calves.
};

}  // namespace mocap
