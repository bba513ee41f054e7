// A pose as a line of JSON.
#pragma once

#include <string>

#include "tools/stream/pose_feed.h"

namespace mocap {

/// One object without its line's end: utime [µs], frame, state; person and name where there are
/// several; of who is tracked torso_mm, torso_rotation (3 × 3, row by row: T to W), joints_rad and
/// points_mm by name, points_std_mm, residual_mm. Lengths are rounded to µm, angles to µrad.
std::string PoseJson(const StreamedPose& pose);

}  // namespace mocap
