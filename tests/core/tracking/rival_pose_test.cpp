#include "core/tracking/rival_pose.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/seen_body.h"

namespace mocap {
namespace {

constexpr double kPeriod_s = 1.0 / 30;

class Rival : public ::testing::Test {
 protected:
  PoseState With(const ArmStance& left) const {
    PoseState pose;
    pose.X_WT.p.z() = body_.sizes().torso / 2 + body_.sizes().thigh + body_.sizes().calf;
    pose.theta = AnglesOf({.arm_l = left}, body_.table());
    return pose;
  }
  /// Follows a rival through frames that all show `truth`.
  RivalPose::Rank Follow(const PoseState& present, const PoseState& rival, const PoseState& truth,
                         int frames, double period_s = kPeriod_s) const {
    const Evidence evidence = studio_.Show(body_, truth);
    SurfaceFit fit{SurfaceFitOptions{}};
    fit.SetEvidence(evidence);
    const double present_mm = fit.QualityAt(body_, present).Cost();
    PoseFilter filter{MotionNoise{}};
    filter.Reset(present, 20, 0.1);
    RivalPose pose(filter, rival, present_mm);
    RivalPose::Rank rank = RivalPose::Rank::kUndecided;
    for (int i = 0; i < frames && rank == RivalPose::Rank::kUndecided; ++i)
      rank = pose.Follow(body_, fit, present, present_mm, period_s);
    return rank;
  }

  RoundStudio studio_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  const PoseState hanging_ = With({}), raised_ = With({.raise = 30, .forward = 30, .elbow = 60});
};

TEST_F(Rival, ThatExplainsMoreProvesBetter) {
  EXPECT_EQ(Follow(hanging_, raised_, raised_, 6), RivalPose::Rank::kBetter);
}

TEST_F(Rival, ThatExplainsLessProvesWorse) {
  EXPECT_EQ(Follow(raised_, hanging_, raised_, 6), RivalPose::Rank::kWorse);
}

TEST_F(Rival, IsNotChosenByASingleFrame) {
  EXPECT_EQ(Follow(hanging_, raised_, raised_, 1), RivalPose::Rank::kUndecided);
}

TEST_F(Rival, IsChosenByASingleFrameIfFramesAreRare) {
  EXPECT_EQ(Follow(hanging_, raised_, raised_, 1, 0.1), RivalPose::Rank::kBetter);
}

TEST_F(Rival, ThatBecomesThePresentPoseIsGivenUp) {
  EXPECT_EQ(Follow(hanging_, With({.raise = -75}), hanging_, 1), RivalPose::Rank::kWorse);
}

TEST_F(Rival, ThatExplainsAsMuchIsGivenUpAfterAWhile) {
  const Evidence evidence = studio_.Show(body_, raised_);
  SurfaceFit fit{SurfaceFitOptions{}};
  fit.SetEvidence(evidence);
  PoseFilter filter{MotionNoise{}};
  filter.Reset(hanging_, 20, 0.1);
  RivalPose rival(filter, raised_, 0);
  RivalPose::Rank rank = RivalPose::Rank::kUndecided;
  int frames = 0;
  for (; rank == RivalPose::Rank::kUndecided && frames < 40; ++frames) {
    const double same_mm = fit.QualityAt(body_, rival.filter().pose()).Cost();
    rank = rival.Follow(body_, fit, hanging_, same_mm, kPeriod_s);
  }
  EXPECT_EQ(rank, RivalPose::Rank::kWorse);
  EXPECT_NEAR(frames, 12, 1);
}

}  // namespace
}  // namespace mocap
