// Overlap of the projected voxels with the silhouettes from which they were carved.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Sets every pixel that shows part of an occupied voxel to 255, others to 0. Projects all corners
/// of the voxels through the exact lens, independently of the carver's table.
Image<std::uint8_t> ProjectVoxels(const VoxelGrid& grid, const CameraCalibration& camera,
                                  const RigidTransform& X_CW);

/// Intersection over union of a projection and a silhouette of the same size; 1 if both are empty.
double OverlapOf(const Image<std::uint8_t>& painted, const Silhouette& silhouette);

/// One camera's overlaps over the sampled frames.
struct CameraOverlap {
  std::string camera;
  std::vector<double> iou;  ///< One per sampled moment; NaN if the camera has no frame.
  /// Mean share of unknown pixels where the camera shows people; empty if it never does.
  std::optional<double> unknown_share = {};

  int frames() const;
  double mean() const;  ///< Over its frames; 0 without any.
  double lowest() const;
};

}  // namespace mocap
