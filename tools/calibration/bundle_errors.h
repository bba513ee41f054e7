// Reprojection errors of a bundle, and outliers.
#pragma once

#include <string>
#include <vector>

#include "tools/calibration/bundle.h"

namespace mocap {

/// Reprojection error of a corner.
struct CornerError {
  int detection = 0;
  Vector2 pixel;  ///< Observed.
  Vector2 error_px;
  double depth_mm = 0;
};

/// Errors of all corners of boards with known pose; infinite if the camera could not see the point.
std::vector<CornerError> BundleErrors(const BoardDetections& detections, const Bundle& bundle);

/// Root mean square of the distances; of one camera or (-1) of all.
double RmsPx(const std::vector<CornerError>& errors, const BoardDetections& detections, int camera);

/// The view of a camera with the largest reprojection error.
struct ViewError {
  std::string frame;  ///< Its name; "no frame" without any view.
  double rms_px = 0;
};
ViewError WorstView(const std::vector<CornerError>& errors, const BoardDetections& detections,
                    int camera);

/// Removes corners with more than three times the usual error (and a pixel), and views that keep
/// fewer than four. @return  the number of corners removed.
int DropOutliers(const Bundle& bundle, BoardDetections& detections);

}  // namespace mocap
