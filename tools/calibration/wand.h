// A wand with a light at each end, for rooms in which a board is too small. The ends need not
// differ in colour or size: both assignments are tried. For the bundle adjustment, it is a board
// with two corners.
#pragma once

#include <vector>

#include "core/image.h"
#include "tools/calibration/bundle.h"
#include "tools/calibration/detections.h"

namespace mocap {

/// Finds the brightest small spots of a picture, with subpixel accuracy.
std::vector<Vector2> FindSpots(ImageView<const Bgr> image);

/// Keeps those of one camera's frames, in order of time, in which two spots move: lamps do not. The
/// spots are numbered 0 and 1, consistently from frame to frame. Which end is which is unknown.
void KeepWands(std::vector<BoardDetection>& of_camera);

/// Transform from camera B's points to camera A.
struct CameraLink {
  int shared = 0;  ///< Moments that support it.
  RigidTransform X_AB;
};

/// Computes the relative pose of two cameras from wands seen at the same moments (five-point
/// algorithm, over both assignments of the ends); the wand's length gives the scale. Deterministic.
CameraLink LinkByWand(const BoardDetections& detections,
                      const std::vector<CameraCalibration>& cameras, int a, int b);

/// Places the wand at each moment that two placed cameras saw, and numbers its ends consistently in
/// all of them.
void PlaceWands(BoardDetections& detections, Bundle& bundle);

}  // namespace mocap
