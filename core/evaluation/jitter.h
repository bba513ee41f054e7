// How smooth a motion is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/evaluation/accuracy.h"

namespace mocap {

/// Mean length of the third difference of points from frame to frame [mm]: what is left when a
/// constant acceleration is taken away. It has the motion's own jerk in it, so that it is compared
/// with the truth's. Empty if no run has four frames.
/// @param runs  of points in successive frames.
std::optional<double> MeanThirdDifference_mm(std::span<const std::vector<ScoredPoints>> runs);

}  // namespace mocap
