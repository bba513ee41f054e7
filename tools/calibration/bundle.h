// Bundle adjustment: cameras, lenses and boards together, so that corners fall where they were
// seen.
#pragma once

#include <optional>
#include <vector>

#include "core/reconstruction/camera/camera_model.h"
#include "tools/calibration/detections.h"

namespace mocap {

/// Cameras and the board at each moment, in one frame.
struct Bundle {
  std::vector<CameraCalibration> cameras;
  /// Board at each moment: points of the board B to the world. Empty where it is not known.
  std::vector<std::optional<RigidTransform>> X_WB;
  /// How much later than its time stamp each camera exposes, against the first [s]. Empty: none.
  std::vector<double> lateness_s;
};

struct BundleOptions {
  bool refine_lenses = true;
  bool refine_poses = true;  ///< Of the cameras; the first stays where it is.
  bool refine_boards = true;
  bool refine_lateness = false;  ///< Where velocities of corners are known.
  /// A view whose error exceeds this counts less and less; 0: all count the same.
  double robust_px = 0;
  int most_steps = 60;
};

/// Refines in place with Ceres. Detections of unknown boards are passed over. Deterministic.
/// @return  false when it did not settle.
bool RefineBundle(const BoardDetections& detections, const BundleOptions& options, Bundle& bundle);

}  // namespace mocap
