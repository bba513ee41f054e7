// How far corners lie from where the bundle puts them, and what that tells.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle.h"

namespace mocap {

/// Distance between a corner as projected and as seen.
struct CornerError {
  int detection = 0;
  Vector2 pixel;  ///< Seen.
  Vector2 error_px;
  double depth_mm = 0;
};

/// Errors of all corners of known boards; infinite where the camera could not see the place.
std::vector<CornerError> BundleErrors(const BoardDetections& detections, const Bundle& bundle);

/// Root mean square of the distances; of one camera or (-1) of all.
double RmsPx(const std::vector<CornerError>& errors, const BoardDetections& detections, int camera);

/// The view of a camera whose corners lie farthest from where the bundle puts them.
struct ViewError {
  std::string frame;  ///< Its name; "no frame" without any view.
  double rms_px = 0;
};
ViewError WorstView(const std::vector<CornerError>& errors, const BoardDetections& detections,
                    int camera);

/// Removes corners that lie more than three times the common error (and a pixel) from where the
/// bundle puts them, and views that keep fewer than four. @return  how many corners went.
int DropOutliers(const Bundle& bundle, BoardDetections& detections);

}  // namespace mocap
