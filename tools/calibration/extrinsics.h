// Extrinsics of all cameras in one frame, from boards seen by several at once.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle.h"
#include "tools/calibration/detections.h"
#include "tools/calibration/lens_fit.h"

namespace mocap {

/// Result for one camera.
struct CameraFit {
  std::string name;
  double lens_rms_px = 0;        ///< Of its intrinsic fit; 0 if the intrinsics were given.
  double focal_sigma_share = 0;  ///< Of its intrinsic fit: standard deviation over the focal
                                 ///< length.
  double rms_px = 0;             ///< In the bundle adjustment.
  int views = 0;
  int corners = 0;
  Coverage coverage;
};

/// All cameras in the frame of the first, or in the world once a floor is set.
struct StudioFit {
  Bundle bundle;
  BoardDetections detections;  ///< Without outliers.
  std::vector<CameraFit> cameras;
  double rms_px = 0;
  int dropped_corners = 0;
  bool has_poses = true;  ///< False for intrinsics alone: every pose is the identity.
  bool has_floor = false;
};

struct ExtrinsicsOptions {
  bool refine_lenses = true;
};

/// Finds the extrinsics of all cameras in one frame: pairs from shared views, then bundle
/// adjustment.
///
/// @param lenses  one per camera of the detections; X_CW is ignored.
/// @throws SetupError  naming camera and remedy: a board that looks the same turned, cameras that
/// share no views, cameras that contradict each other.
StudioFit FitExtrinsics(const BoardDetections& detections,
                        const std::vector<CameraCalibration>& lenses,
                        const ExtrinsicsOptions& options);

/// Changes the world frame: `X_NW` maps the bundle's world to the new one.
void MoveWorld(const RigidTransform& X_NW, Bundle& bundle);

/// Computes errors and coverage of the bundle.
void MeasureFit(StudioFit& fit);

}  // namespace mocap
