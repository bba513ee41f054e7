// Bundle adjustment: cameras, lenses and boards together, so that corners fall where they were
// seen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/camera_model.h"
#include "tools/calibration/sightings.h"

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

/// Refines in place with Ceres. Sightings of unknown boards are passed over. Deterministic.
/// @return  false when it did not settle.
bool RefineBundle(const BoardSightings& sightings, const BundleOptions& options, Bundle& bundle);

/// Distance between a corner as projected and as seen.
struct CornerError {
  int sighting = 0;
  Vector2 pixel;  ///< Seen.
  Vector2 error_px;
  double depth_mm = 0;
};

/// Errors of all corners of known boards; infinite where the camera could not see the place.
std::vector<CornerError> BundleErrors(const BoardSightings& sightings, const Bundle& bundle);

/// Root mean square of the distances; of one camera or (-1) of all.
double RmsPx(const std::vector<CornerError>& errors, const BoardSightings& sightings, int camera);

/// Removes corners that lie more than three times the common error (and a pixel) from where the
/// bundle puts them, and views that keep fewer than four. @return  how many corners went.
int DropOutliers(const Bundle& bundle, BoardSightings& sightings);

}  // namespace mocap
