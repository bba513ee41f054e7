// A body, what cameras see of it, and the objective of that.
#pragma once

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/hypotheses/hypothesis.h"
#include "tests/support/seen_body.h"
#include "tests/support/standing_height.h"

namespace mocap {

inline constexpr ArmStance kArmOut{.raise = -20, .forward = 20, .elbow = 40};
inline constexpr LegStance kStep{.hip = 25, .knee = 20};

class FittedBody : public ::testing::Test {
 protected:
  PoseState Standing(const BodyModel& body, const Stance& stance) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, 0.4));
    pose.X_WT.p = Vector3(50, -30, 0);
    pose.theta = AnglesOf(stance, body.table());
    PutOnFloor(body, pose);
    return pose;
  }
  PoseState Standing(const Stance& stance) const { return Standing(body_, stance); }
  /// Like a pose, but some centimetres and degrees off.
  static PoseState Off(PoseState pose, double share = 1) {
    PoseStep step = PoseStep::Constant(pose.dof(), 0.05 * share);
    step.head<3>() = share * Vector3(40, -30, 25);
    pose.Add(step);
    return pose;
  }

  /// Sets the evidence of a frame.
  void See(const BodyModel& body, const PoseState& truth) { See(studio_.Show(body, truth)); }
  void See(const PoseState& truth) { See(body_, truth); }
  void See(Evidence evidence) {
    evidence_ = std::move(evidence);
    objective_.SetEvidence(evidence_);
  }

  Fitness At(const PoseState& pose) { return objective_.At(body_, pose, {}); }
  /// Draws the body near the evidence, from a start that may be far off.
  PoseState FitFrom(const PoseState& start, const BodyModel& body) {
    PoseFilter filter{MotionNoise{}};
    filter.Reset(start, 100, 0.5);
    DrawNear(objective_, body, {}, {12, 12}, filter);
    return filter.pose();
  }
  PoseState FitFrom(const PoseState& start) { return FitFrom(start, body_); }
  /// The body as a hypothesis that was fitted to the evidence.
  Hypothesis HypothesisAt(const PoseState& pose) {
    Hypothesis hypothesis(body_, pose, false);
    hypothesis.Fit(objective_);
    return hypothesis;
  }

  Eigen::VectorXd Errors(const PoseState& pose, const PoseState& truth) const {
    return (body_.PointsAt(body_.PostureAt(pose)) - body_.PointsAt(body_.PostureAt(truth)))
        .colwise()
        .norm();
  }
  double Error(const PoseState& pose, const PoseState& truth) const {
    return Errors(pose, truth).mean();
  }

  RoundStudio studio_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  Evidence evidence_;
  Objective objective_;
};

}  // namespace mocap
