// A pose as a line of JSON.
#pragma once

#include <string>

#include "tools/stream/pose_feed.h"

namespace mocap {

/// One object without line end. Fields: utime [µs], frame, state. With several people: person and
/// name. If tracked: torso_mm, torso_rotation (3 × 3, row by row: T to W), joints_rad and points_mm
/// by name, points_std_mm, residual_mm; probability, if known. Lengths are rounded to µm, angles to
/// µrad.
std::string PoseJson(const StreamedPose& pose);

}  // namespace mocap
