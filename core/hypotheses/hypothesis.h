// One explanation of what is seen: a body and its motion.
#pragma once

#include <optional>

#include "core/body/body_model.h"
#include "core/hypotheses/pose_filter.h"
#include "core/hypotheses/size_refiner.h"
#include "core/objective/objective.h"

namespace mocap {

/// A body that may be the person's, and how well it has explained the evidence.
struct Hypothesis {
  /// Starts with a body at a pose. @param measures  whether its sizes are unknown.
  Hypothesis(const BodyModel& body, const PoseState& pose, bool measures);

  BodyModel body;
  PoseFilter filter;
  std::optional<SizeRefiner> sizes;  ///< Empty: the sizes are known.
  Things things;                     ///< What it may wear or carry.
  Fitness fitness;                   ///< In the last frame.
  double nats = 0;                   ///< -log p, integrated over time; only differences count.
  /// Proposals that it has a right to before it may be dropped: somebody who was just found may
  /// have his limbs elsewhere.
  int trials = 0;

  /// Fits the body to a frame's evidence.
  void Fit(Objective& objective);
  /// Moves it to another pose, and fits it there.
  void Jump(Objective& objective, const PoseState& pose);
  /// Measures the sizes in a frame, each time from the pose that the new sizes lead to.
  void MeasureSizes(Objective& objective);
  /// Adds a frame to the measurements of the sizes.
  void RefineSizes(Objective& objective);
};

/// Draws a body's pose near the evidence.
/// @param filter  at the pose to start from.
void DrawNear(Objective& objective, const BodyModel& body, const Things& things,
              const Iterations& iterations, PoseFilter& filter);

/// Mean distance of the points of two bodies [mm].
double MeanDistance(const BodyModel& a, const PoseState& pose_a, const BodyModel& b,
                    const PoseState& pose_b);

}  // namespace mocap
