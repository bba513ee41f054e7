// How long something must last is counted in time with frame sets.
#pragma once

#include <algorithm>

namespace mocap {

/// The time before a set counts for no longer than this: after a gap, one set tells no more.
inline constexpr double kMostCountedS = 0.2;

/// Returns how much of the time since the last set counts.
inline double CountedS(double dt_s) { return std::min(dt_s, kMostCountedS); }

}  // namespace mocap
