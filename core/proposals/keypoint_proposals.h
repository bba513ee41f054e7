// Poses that pose networks suggest.
#pragma once

#include <span>
#include <vector>

#include "core/evidence/keypoint_rays.h"
#include "core/hypotheses/hypothesis.h"

namespace mocap {

/// Fits a body to keypoints alone, from its present pose and from the same turned about, and then
/// to the whole frame.
/// @param views  of the last moments, as they would be now.
/// @param poses  gets those that were found.
void ProposeByKeypoints(Objective& objective, const Hypothesis& present,
                        std::span<const KeypointRays> views, std::vector<PoseState>& poses);

}  // namespace mocap
