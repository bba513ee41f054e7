// Fig. 5, Table 2 and Fig. 8 (g): measures the 23 points from labelled voxels.
#pragma once

#include <array>

#include "core/mikic2003/labels.h"
#include "core/mikic2003/limbs.h"
#include "core/reconstruction/carving/voxel_cloud.h"

namespace mocap::mikic2003 {

/// A frame whose voxels are labelled.
struct LabeledFrame {
  Labels labels;
  Vector3 neck_W = Vector3::Zero();
  /// Direction of each limb's upper arm or thigh away from the torso.
  std::array<Vector3, kLimbCount> upper_axes_W{};
};

/// Measures centroids and ends of the labelled parts. Table 2.
///
/// The paper does not define ends. Here an end is the mean of the farthest twentieth of a part's
/// voxels. Shoulders and hips are the near ends of upper arms and thighs along their axes, elbows
/// and knees the far ends. Fingertips and feet are farthest from elbow and knee. Parts of less than
/// 0.1 litres are not measured.
MeasuredPoints MeasurePoints(const VoxelCloud& cloud, const LabeledFrame& frame);

}  // namespace mocap::mikic2003
