// A wand with a light at either end: where a board is too small for the room.
#pragma once

#include <vector>

#include "core/image.h"
#include "tools/calibration/bundle.h"
#include "tools/calibration/detections.h"

namespace mocap {

/// Finds small bright spots, to a fraction of a pixel, the brightest of the picture.
std::vector<Vector2> FindSpots(ImageView<const Bgr> image);

/// Leaves those of one camera's frames, in the order of time, in which two spots move: lamps stay
/// where they are. The two are named 0 and 1, the same from frame to frame; which end of the wand
/// that is, is not known.
void KeepWands(std::vector<BoardDetection>& of_camera);

/// How camera B's points come to camera A.
struct CameraLink {
  int shared = 0;  ///< Moments that tell of it.
  RigidTransform X_AB;
};

/// Tells from wands that two cameras saw at the same moments how the cameras stand to each other
/// (five-point algorithm, over both ways in which the ends may belong together); the wand's length
/// gives the scale. Deterministic.
CameraLink LinkByWand(const BoardDetections& detections,
                      const std::vector<CameraCalibration>& cameras, int a, int b);

/// Places the wand at each moment that two placed cameras saw, and names its ends alike in all of
/// them.
void PlaceWands(BoardDetections& detections, Bundle& bundle);

}  // namespace mocap
