// Poses that pose networks suggest.
#pragma once

#include <optional>
#include <span>

#include "core/evidence/keypoint_rays.h"
#include "core/hypotheses/hypothesis.h"

namespace mocap {

/// Fits a body to keypoints alone, from its present pose and with the trunk turned about each of
/// its axes, and the best of these to the whole frame.
/// @param views  of the last moments, as they would be now.
/// @return  empty: none explains the keypoints better than the present pose.
std::optional<PoseState> ProposeByKeypoints(Objective& objective, const Hypothesis& present,
                                            std::span<const KeypointRays> views);

}  // namespace mocap
