// What the exported formats share: their axes and their clock.
#pragma once

#include <algorithm>
#include <vector>

#include "core/geometry.h"
#include "tools/result.h"

namespace mocap {

/// Turns the world (x forward, y left, z up) into what animation and biomechanics expect: y up, a
/// person that faced world x faces z, and has its left towards x. A rotation, never a reflection.
inline Matrix3 YUpFromWorld() {
  Matrix3 R;
  R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  return R;
}

/// Mean time between frames [s]; for formats that know one rate only.
inline double FramePeriod(const std::vector<PoseRow>& poses) {
  if (poses.size() < 2) return 1.0 / 30;
  const auto span_ns = static_cast<double>(poses.back().timestamp_ns - poses.front().timestamp_ns);
  return std::max(1e-9 * span_ns / (static_cast<double>(poses.size()) - 1), 1e-6);
}

inline bool IsTracked(const PoseRow& row) {
  return row.state == CaptureState::kTracking && row.has_pose;
}

}  // namespace mocap
