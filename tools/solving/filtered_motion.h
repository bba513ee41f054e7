// Applies a named filter to a person's motion.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/body/body_model.h"
#include "core/motion_capture.h"
#include "tools/solving/butterworth.h"

namespace mocap {

/// A pose at a moment.
struct SolvedPose {
  int set = 0;
  std::int64_t capture_ns = 0;
  CaptureResult result;
};

/// Filters position, rotation and joint angles of each stretch without gaps at its true rate, and
/// computes the points from them: the body keeps its sizes.
/// @param poses  in order of time.
void FilterMotion(const BodyModel& body, const NamedFilter& filter, std::span<SolvedPose> poses);

}  // namespace mocap
