// True points of a simulated person, as scores need them.
#pragma once

#include <algorithm>

#include "core/evaluation/accuracy.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/results/take_truth.h"

namespace mocap {

/// Selects the scored points from the simulated joints; feet are soles.
inline ScoredPoints TrueScoredPoints(const SimulatedTruth& truth, std::int64_t capture_ns,
                                     int person = 0) {
  const JointPositions joints = truth.At(capture_ns, person);
  ScoredPoints points_W;
  for (int i = 0; i < kScoredPointCount; ++i) {
    const auto joint = std::ranges::find(kSimulatedJointNames, RigJoint(kScoredPoints[i]));
    points_W.col(i) = joints[joint - kSimulatedJointNames.begin()];
  }
  ProlongShanks(truth.Sizes(person).ankle_to_sole_mm, points_W);
  return points_W;
}

}  // namespace mocap
