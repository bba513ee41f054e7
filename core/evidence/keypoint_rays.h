// Keypoints as lines of sight.
#pragma once

#include <cstdint>
#include <vector>

#include "core/evidence/keypoint_view.h"
#include "core/geometry.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// A line of sight on which a point of the person lies.
struct KeypointRay {
  Landmark landmark = Landmark::kNose;
  float score = 0;      ///< As in Keypoint.
  Vector3 eye_W;        ///< [mm]
  Vector3 direction_W;  ///< Unit length, away from the camera.
};

/// The keypoints of one person in one picture, seen from there.
struct KeypointRays {
  int view = 0;  ///< Number of the view in its set.
  int camera = 0;
  double after_s = 0;  ///< When the picture was taken, after the time of the set.
  /// How much its -log p counts, 0 to 1: errors of successive views of a camera are alike.
  double worth = 1;
  std::vector<KeypointRay> rays;
};

/// Casts a view's keypoints into the room; those that the lens does not cover are left out.
/// @param X_CW    pose of the camera.
/// @param set_ns  time of the set that the rays belong to.
KeypointRays CastKeypoints(const KeypointView& view, int camera, const Lens& lens,
                           const RigidTransform& X_CW, std::int64_t set_ns);

}  // namespace mocap
