// How well the carved voxels, projected back, cover the silhouettes they were carved from.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/camera/camera_model.h"
#include "core/reconstruction/carving/voxel_grid.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// Paints every pixel that shows some part of an occupied voxel; 255 there, 0 elsewhere. Voxels are
/// projected corner by corner through the exact lens, independently of the carver's table.
Image<std::uint8_t> ProjectVoxels(const VoxelGrid& grid, const CameraCalibration& camera,
                                  const RigidTransform& X_CW);

/// Intersection over union of a painted picture and a silhouette of the same size; 1 when both are
/// empty.
double OverlapOf(const Image<std::uint8_t>& painted, const Silhouette& silhouette);

/// One camera's overlaps over the sampled frames.
struct CameraOverlap {
  std::string camera;
  std::vector<double> iou;  ///< One a sampled moment; NaN where the camera has no frame.

  int frames() const;
  double mean() const;  ///< Over its frames; 0 without any.
  double lowest() const;
};

}  // namespace mocap
