// Keypoints as LCM messages, and back.
#pragma once

#include <mocap/keypoints_t.hpp>

#include "core/evidence/keypoint_view.h"
#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// More points in a message are not those of a person.
inline constexpr int kMostKeypoints = 256;

/// What can be used of a message.
struct UsableKeypoints {
  KeypointView view;
  int dropped = 0;  ///< Points that were left out.
};

/// Whether a message is of this version, and its numbers but those of the points are plausible.
/// Anyone may have sent it.
bool IsSound(const keypoints_t& message);

/// Takes from a message what can be used: points that have a place on the body, a pixel of the
/// picture and a score from 0 to 1. Of two of the same name, the first.
/// @param camera   of the message. @pre  IsSound(message).
/// @return  its time is the message's.
UsableKeypoints UsableOf(const keypoints_t& message, const CameraCalibration& camera);

/// Fills all fields but the sender.
void FillKeypoints(const KeypointView& view, keypoints_t& message);

}  // namespace mocap
