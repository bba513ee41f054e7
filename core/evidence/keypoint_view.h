// What a pose network says of one person in one picture.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/body/landmarks.h"

namespace mocap {

/// A point of a person in a picture.
struct Keypoint {
  Landmark landmark = Landmark::kNose;
  Eigen::Vector2f px = {0, 0};  ///< In the picture as the camera sent it: x right, y down.
  float score = 0;              ///< 0 to 1: how sure the network is.
};

/// The keypoints of one person in one picture.
struct KeypointView {
  std::string camera;
  std::int64_t capture_ns = 0;  ///< Of the picture.
  int person = 0;               ///< Tells people of one picture apart; numbers mean nothing else.
  std::vector<Keypoint> points;
  std::string sender = {};  ///< Empty: not known.
};

}  // namespace mocap
