// How certain the points and joints of a pose are.
#pragma once

#include "core/body/body_model.h"
#include "core/motion_capture.h"

namespace mocap {

/// Sets the standard deviations of a pose's points, along the worst axis of each, and of its joint
/// angles.
/// @param covariance  of the pose.
void SetDeviations(const BodyModel& body, const Posture& posture, const PoseCovariance& covariance,
                   CaptureResult& result);

/// Adds the error of the joints' places in the body, which no fit shows.
void AddBodyError(CaptureResult& result);

}  // namespace mocap
