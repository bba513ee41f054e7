// Axes and clock that the exported formats share.
#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry.h"
#include "tools/results/result.h"

namespace mocap {

/// Turns the world (x forward, y left, z up) into what animation and biomechanics expect: y up, a
/// person that faced world x faces z, and has its left towards x. A rotation, never a reflection.
inline Matrix3 YUpFromWorld() {
  Matrix3 R;
  R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return R;
}

/// The rate that formats with one rate only are given.
struct EvenClock {
  double period_s = 1.0 / 30;
  /// Periods from the row before to each row: more than 1 where frames are missing.
  std::vector<std::int64_t> steps;
};

/// Fits a clock to frames that may jitter and of which some may be missing.
EvenClock FitClock(const std::vector<PoseRow>& poses);

/// Exports fill in frames that are missing.
/// @throws SetupError  when so many are missing before a row that these are two recordings, or
/// times that are wrong: an hour at 30 frames a second.
void RequireShortGap(std::int64_t missing, const PoseRow& row);

inline bool IsTracked(const PoseRow& row) {
  return row.state == CaptureState::kTracking && row.has_pose;
}

}  // namespace mocap
