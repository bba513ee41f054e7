// A person made of the model's own flesh, as voxels: for tests that need a body without cameras.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/body/body_model.h"
#include "core/reconstruction/carving/voxel_grid.h"

namespace mocap {

/// Fills every voxel whose centre lies in the body; the grid spans the body with a margin.
inline VoxelGrid Voxelize(const BodyModel& body, const PoseState& pose, double voxel_mm) {
  std::vector<PosedCapsule> flesh;
  body.PoseShape(body.PostureAt(pose), flesh);
  Vector3 low = pose.X_WT.p;
  Vector3 high = pose.X_WT.p;
  for (const PosedCapsule& capsule : flesh) {
    const double radius = std::max(capsule.radius_a_mm, capsule.radius_b_mm);
    low = low.cwiseMin(capsule.a_W.cwiseMin(capsule.b_W).array().matrix() -
                       Vector3::Constant(radius));
    high = high.cwiseMax(capsule.a_W.cwiseMax(capsule.b_W) + Vector3::Constant(radius));
  }
  const auto cell = [&](double mm) { return static_cast<int>(std::floor(mm / voxel_mm)); };
  const Eigen::Vector3i first(cell(low.x()) - 2, cell(low.y()) - 2, cell(low.z()) - 2);
  const Eigen::Vector3i last(cell(high.x()) + 3, cell(high.y()) + 3, cell(high.z()) + 3);
  VoxelGrid grid;
  grid.Reset(first, last - first, voxel_mm);
  for (int k = 0; k < grid.size().z(); ++k) {
    for (int j = 0; j < grid.size().y(); ++j) {
      for (int i = 0; i < grid.size().x(); ++i) {
        const Vector3 center_W = grid.CenterOf(i, j, k);
        const bool inside = std::any_of(flesh.begin(), flesh.end(), [&](const auto& capsule) {
          return capsule.DistanceTo(center_W).outside_mm <= 0;
        });
        if (inside) grid.Set(i, j, k);
      }
    }
  }
  return grid;
}

}  // namespace mocap
