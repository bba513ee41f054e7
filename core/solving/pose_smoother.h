// The smoother of Rauch, Tung and Striebel (1965) in the tangent space of the pose.
#pragma once

#include <span>
#include <vector>

#include "core/hypotheses/pose_filter.h"

namespace mocap {

/// A pose that all sets have a say in.
struct SmoothedPose {
  PoseState pose;
  PoseCovariance covariance;
};

/// Smooths what a filter has found forward in time. The filter's state is pose and velocity, so
/// that a motion goes on through sets without evidence.
/// @param filtered  after each set.
/// @param dt_s      time since the set before; as many.
std::vector<SmoothedPose> Smooth(std::span<const MotionState> filtered,
                                 std::span<const double> dt_s, const MotionNoise& noise);

}  // namespace mocap
