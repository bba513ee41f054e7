// A body, what cameras see of it, and the fit and the recovery of limbs to that.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "core/tracking/limb_recovery.h"
#include "core/tracking/surface_fit.h"
#include "tests/support/seen_body.h"

namespace mocap {

inline constexpr ArmStance kArmOut{.raise = -20, .forward = 20, .elbow = 40};
inline constexpr LegStance kStep{.hip = 25, .knee = 20};

class FittedBody : public ::testing::Test {
 protected:
  PoseState Standing(const BodyModel& body, const Stance& stance) const {
    PoseState pose;
    pose.X_WT.R = ExpRotation(Vector3(0, 0, 0.4));
    pose.X_WT.p = Vector3(50, -30, body.sizes().torso / 2 + body.sizes().thigh + body.sizes().calf);
    pose.theta = AnglesOf(stance, body.table());
    return pose;
  }
  PoseState FitFrom(const PoseState& start, const BodyModel& body, SurfaceFit& fit) const {
    PoseFilter filter{MotionNoise{}};
    filter.Reset(start, 100, 0.5);
    filter.Update(body.table(),
                  [&](const PoseState& pose, UpdateEquations& equations) {
                    fit.Linearize(body, pose, equations);
                  },
                  {12, 12});
    return filter.pose();
  }
  PoseState FitFromStance(const Evidence& evidence, const Stance& stance) {
    fit_.SetEvidence(evidence);
    return FitFrom(Standing(body_, stance), body_, fit_);
  }
  /// @param dt_s  since the last search; by default all is searched at once.
  std::optional<PoseState> Recover(const Evidence& evidence, const PoseState& pose,
                                   double dt_s = 0.1) {
    fit_.SetEvidence(evidence);
    return recovery_.Recover(body_, evidence, fit_, pose, fit_.QualityAt(body_, pose), dt_s);
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
  SurfaceFit fit_{SurfaceFitOptions{}};
  LimbRecovery recovery_{body_.table()};
};

}  // namespace mocap
