// Bundle adjustment: joint fit of camera poses, intrinsics and board poses.
#pragma once

#include <optional>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/detections.h"

namespace mocap {

/// Cameras, and the board at each moment, in one frame.
struct Bundle {
  std::vector<CameraCalibration> cameras;
  /// Pose of the board at each moment, board B to world. Empty if unknown.
  std::vector<std::optional<RigidTransform>> X_WB;
  /// Delay of each camera's exposure after its timestamp, relative to the first camera [s]. Empty:
  /// none.
  std::vector<double> lateness_s;
};

struct BundleOptions {
  bool refine_lenses = true;
  bool refine_poses = true;  ///< Of the cameras; the first is fixed.
  bool refine_boards = true;
  bool refine_lateness = false;  ///< Requires velocities of corners.
  /// Views with larger errors get less weight; 0: all have the same weight.
  double robust_px = 0;
  int most_steps = 60;
};

/// Refines in place with Ceres. Skips detections of boards with unknown pose. Deterministic.
/// @return  false when it did not converge.
bool RefineBundle(const BoardDetections& detections, const BundleOptions& options, Bundle& bundle);

}  // namespace mocap
