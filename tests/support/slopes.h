// Derivatives of -log p, taken numerically.
#pragma once

#include <gtest/gtest.h>

#include "core/body/posed_body.h"

namespace mocap {

/// Derivative of a function of the pose by each part of a PoseStep, by central differences. Steps
/// are so small that hardly any contact changes its part.
template <typename Nats>
PoseStep SlopeOf(const Nats& nats, const PoseState& pose) {
  PoseStep slope(pose.dof());
  for (int i = 0; i < pose.dof(); ++i) {
    const double small = i < 3 ? 1e-5 : 1e-7;
    const auto moved = [&](double by) {
      PoseState to = pose;
      PoseStep step = PoseStep::Zero(pose.dof());
      step[i] = by;
      to.Add(step);
      return nats(to);
    };
    slope[i] = (moved(small) - moved(-small)) / (2 * small);
  }
  return slope;
}

/// Linearised terms at a pose, as their gradient of log p.
/// @param linearize  adds to a Linearisation.
template <typename Linearize>
PoseStep GradientOf(const BodyModel& body, const PoseState& pose, const Linearize& linearize) {
  PosedBody posed;
  posed.Set(body, pose);
  ChainEquations chain;
  chain.Reset(body.table(), posed.posture());
  UpdateEquations equations;
  equations.Reset(body.dof());
  Linearisation sums{chain, equations};
  linearize(posed, sums);
  chain.AddTo(equations);
  return equations.gradient();
}

/// Translations [mm] count like turns of a part that is a metre long.
inline PoseStep PerMetre(PoseStep slope) {
  slope.head<3>() *= 1000;
  return slope;
}

/// Expects that a step along the gradient of log p decreases -log p as its slope says.
/// @param share  of the largest entry by which each may differ.
inline void ExpectOpposite(const PoseStep& gradient, const PoseStep& slope, double share) {
  const PoseStep wanted = -PerMetre(slope), found = PerMetre(gradient);
  const double most = wanted.cwiseAbs().maxCoeff();
  ASSERT_GT(most, 1) << "nothing pulls";
  for (int i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], share * most) << "part " << i;
}

}  // namespace mocap
