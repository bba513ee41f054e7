#include "core/tracking/limb_recovery.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

constexpr double kAtTenHz_s = 0.1;
constexpr double kAtThirtyHz_s = 1.0 / 30;
constexpr LegStance kAhead{.hip = 45, .spread = 5, .knee = 20};
constexpr LegStance kBehind{.hip = -20, .spread = 5, .knee = 80};

class Recovery : public ::testing::Test {
 protected:
  PoseState With(const Stance& stance) const {
    PoseState pose;
    pose.X_WT.p.z() = body_.sizes().torso / 2 + body_.sizes().thigh + body_.sizes().calf;
    pose.theta = AnglesOf(stance, body_.table());
    return pose;
  }
  /// Recovers limbs of a body that is in `truth`, after a first search that found that.
  std::optional<PoseState> Recover(const PoseState& pose, const PoseState& truth, double dt_s) {
    const Evidence evidence = studio_.Show(body_, truth);
    SurfaceFit fit{SurfaceFitOptions{}};
    fit.SetEvidence(evidence);
    const auto recover = [&](const PoseState& from) {
      return recovery_.Recover(body_, evidence, fit, from, fit.QualityAt(body_, from), dt_s);
    };
    recover(truth);
    return recover(pose);
  }
  double FarthestMm(const PoseState& pose, const PoseState& truth) const {
    return (body_.PointsAt(body_.PostureAt(pose)) - body_.PointsAt(body_.PostureAt(truth)))
        .colwise()
        .norm()
        .maxCoeff();
  }

  RoundStudio studio_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  LimbRecovery recovery_{body_.table()};
};

TEST_F(Recovery, LeavesARightPoseAlone) { EXPECT_FALSE(Recover(With({}), With({}), kAtTenHz_s)); }

TEST_F(Recovery, FindsAnArmThatIsElsewhere) {
  const PoseState raised = With({.arm_l = {.raise = 30, .forward = 30, .elbow = 60}});
  const auto found = Recover(With({}), raised, kAtThirtyHz_s);
  ASSERT_TRUE(found);
  EXPECT_LT(FarthestMm(*found, raised), 40);
}

TEST_F(Recovery, FindsTheLegsOfAStride) {
  const auto found = Recover(With({}), With({.leg_l = kAhead, .leg_r = kBehind}), kAtTenHz_s);
  ASSERT_TRUE(found);
  EXPECT_LT(FarthestMm(*found, With({.leg_l = kAhead, .leg_r = kBehind})), 40);
}

TEST_F(Recovery, FindsExchangedLegs) {
  const PoseState left_ahead = With({.leg_l = kAhead, .leg_r = kBehind});
  const PoseState right_ahead = With({.leg_l = kBehind, .leg_r = kAhead});
  const auto found = Recover(right_ahead, left_ahead, kAtTenHz_s);
  ASSERT_TRUE(found);
  EXPECT_LT(FarthestMm(*found, left_ahead), 40);
}

TEST_F(Recovery, TakesASmallGainAtOnceOnlyIfFramesAreRare) {
  const PoseState bent = With({.arm_l = {.elbow = 60}});
  EXPECT_TRUE(Recover(With({}), bent, kAtTenHz_s));
  recovery_ = LimbRecovery(body_.table());
  EXPECT_FALSE(Recover(With({}), bent, kAtThirtyHz_s));
  EXPECT_TRUE(recovery_.rival());
}

}  // namespace
}  // namespace mocap
