// §6.2: labelling of voxels by the predicted body. Fig. 8.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/body/body_model.h"
#include "core/mikic2003/measured_points.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

/// Head and torso of a frame. Fig. 8 (c).
struct LabeledTrunk {
  Labels labels;
  Vector3 neck_W;
  Vector3 down_W;  ///< The torso's axis, away from the neck; unit length.
};

/// Labels head and torso by their shapes, independent of the prediction. Fig. 8 (c).
///
/// A trunk is no cylinder: the torso gets the voxels up to a voxel beside its template, too.
/// @param predicted  where the head is searched.
/// @return  nothing if there is no head or no torso.
std::optional<LabeledTrunk> LabelTrunk(const VoxelCloud& cloud, const BodyModel& body,
                                       const PoseState& predicted);

/// Labels the limbs, moved with the torso, by Mahalanobis distance; then upper arms and thighs by
/// templates in the limbs. Fig. 8 (d)–(f).
/// @param predicted  Fig. 8 (b).
LabeledFrame LabelLimbs(const VoxelCloud& cloud, const BodyModel& body, const LabeledTrunk& trunk,
                        const PoseState& predicted);

/// Moves a predicted body to the measured torso, and keeps its joint angles. Fig. 8 (d).
///
/// The template is round and does not show the direction of the chest. So the torso turns from the
/// prediction by the smallest rotation.
/// @param down_W  the torso's axis, away from the neck; unit length.
PoseState MoveToTorso(const BodyModel& body, const PoseState& predicted, const Vector3& neck_W,
                      const Vector3& down_W);

/// Labels each voxel with the limb (0 to 3) with the least Mahalanobis distance. Fig. 8 (e).
///
/// The paper does not say whose covariance. Here a limb has the mean and the covariance of its two
/// parts as solid cylinders, plus the square of a voxel's edge. The uncertainty of the
/// prediction is left out, because it would give everybody's voxels to a limb that was not seen.
/// @return  the voxels of each limb.
std::array<VoxelIndices, kLimbCount> AssignToLimbs(const VoxelCloud& cloud,
                                                   std::span<const int> voxels,
                                                   const BodyModel& body, const PoseState& pose);

}  // namespace mocap::mikic2003
