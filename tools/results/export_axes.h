// Axes and clock of the exported formats.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// Rotates the world frame (x forward, y left, z up) to that of animation and biomechanics: y up, z
/// along world x, x along world y. A rotation, never a reflection.
inline Matrix3 YUpFromWorld() {
  Matrix3 R;
  R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return R;
}

/// Constant frame rate, for formats that need it.
struct EvenClock {
  double period_s = 1.0 / 30;
  /// Periods since the previous row; more than 1 if frames are missing.
  std::vector<std::int64_t> steps;
};

/// Fits a clock to frames with jitter and gaps.
EvenClock FitClock(const std::vector<PoseRow>& poses);

/// Checks the number of missing frames, which exports fill in.
/// @throws SetupError  when so many are missing before a row (an hour at 30 frames a second) that
/// there are two recordings, or wrong times.
void RequireShortGap(std::int64_t missing, const PoseRow& row);

inline bool IsTracked(const PoseRow& row) {
  return row.state == CaptureState::kTracking && row.has_pose;
}

}  // namespace mocap
