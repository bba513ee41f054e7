// Truth of a simulated person, as scores need it.
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

inline TrueExtremities TrueExtremitiesOf(const SimulatedTruth& truth, std::int64_t capture_ns) {
  const JointPositions joints = truth.At(capture_ns);
  TrueExtremities extremities;
  for (int i = 0; i < kFurtherPointCount; ++i) {
    const auto joint = std::ranges::find(kSimulatedJointNames, kFurtherPointNames[i]);
    if (joint == kSimulatedJointNames.end()) continue;
    extremities.points_W.col(i) = joints[joint - kSimulatedJointNames.begin()];
  }
  const simulation::FloorContacts contacts = truth.ContactsAt(capture_ns);
  std::ranges::copy(contacts, extremities.contacts.begin());
  const SegmentRotations rotations = truth.RotationsAt(capture_ns);
  for (std::size_t i = 0; i < rotations.size(); ++i)
    extremities.rotations.col(i) = LogRotation(rotations[i]);
  return extremities;
}

}  // namespace mocap
