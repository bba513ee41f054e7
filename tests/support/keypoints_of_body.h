// What a perfect pose network says of a body.
#pragma once

#include "core/body/landmarks.h"
#include "core/evidence/keypoint_rays.h"

namespace mocap {

inline KeypointRays KeypointsOf(const BodyModel& body, const PoseState& pose,
                                const Vector3& eye_W) {
  KeypointRays view;
  const Posture posture = body.PostureAt(pose);
  const LandmarkPlaces places = PlaceLandmarks(body);
  for (int i = 0; i < kLandmarkCount; ++i) {
    const Vector3 towards_W = PlaceIn(posture, places[i]) - eye_W;
    view.rays.push_back({static_cast<Landmark>(i), 1, eye_W, towards_W.normalized()});
  }
  return view;
}

}  // namespace mocap
