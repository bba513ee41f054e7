// From boards that several cameras saw at once to all cameras in one frame.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle.h"
#include "tools/calibration/detections.h"
#include "tools/calibration/lens_fit.h"

namespace mocap {

/// Outcome for one camera.
struct CameraFit {
  std::string name;
  double lens_rms_px = 0;        ///< Of its lens alone; 0 when the lens was given.
  double focal_sigma_share = 0;  ///< Of its lens alone: standard deviation over the focal length.
  double rms_px = 0;             ///< In the bundle.
  int views = 0;
  int corners = 0;
  Coverage coverage;
};

/// All cameras in the frame of the first, or in the world once a floor is set.
struct StudioFit {
  Bundle bundle;
  BoardDetections detections;  ///< Those that were kept.
  std::vector<CameraFit> cameras;
  double rms_px = 0;
  int dropped_corners = 0;
  bool has_floor = false;
};

struct ExtrinsicsOptions {
  bool refine_lenses = true;
};

/// Puts all cameras into one frame: pairs from shared views, then a bundle adjustment.
///
/// @param lenses  one a camera of the detections; X_CW is ignored.
/// @throws SetupError  naming camera and remedy: a board that looks the same turned, cameras that
/// share no views, cameras that contradict each other.
StudioFit FitExtrinsics(const BoardDetections& detections,
                        const std::vector<CameraCalibration>& lenses,
                        const ExtrinsicsOptions& options);

/// Moves everything to another world: `X_NW` takes the bundle's world to the new one.
void MoveWorld(const RigidTransform& X_NW, Bundle& bundle);

/// Fills in errors and coverage from the bundle.
void MeasureFit(StudioFit& fit);

}  // namespace mocap
