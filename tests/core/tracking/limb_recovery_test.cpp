#include "core/tracking/limb_recovery.h"

#include <gtest/gtest.h>

#include "tests/support/allocation_counter.h"
#include "tests/support/fitted_body.h"

namespace mocap {
namespace {

class Recovery : public FittedBody {
 protected:
  /// Recovers limbs of a body that is in `truth`, after a first search that found that.
  std::optional<PoseState> RecoverLater(const PoseState& pose, const PoseState& truth,
                                        double dt_s) {
    const Evidence evidence = studio_.Show(body_, truth);
    Recover(evidence, truth, dt_s);
    return Recover(evidence, pose, dt_s);
  }
};

constexpr double kAtThirtyHz_s = 1.0 / 30;
constexpr double kAtTenHz_s = 0.1;
constexpr LegStance kAhead{.hip = 45, .spread = 5, .knee = 20};
constexpr LegStance kBehind{.hip = -20, .spread = 5, .knee = 80};

TEST_F(Recovery, ALostArmIsFoundAgain) {
  const PoseState truth = Standing(body_, {.arm_l = {.raise = 30, .forward = 30, .elbow = 60}});
  const Evidence evidence = studio_.Show(body_, truth);
  const PoseState lost = Standing(body_, {});
  const std::optional<PoseState> found = Recover(evidence, lost);
  ASSERT_TRUE(found);
  EXPECT_LT(Error(FitFrom(*found, body_, fit_), truth), 15);
}

TEST_F(Recovery, FramesThatFollowEachOtherFastShareASearch) {
  const PoseState truth = Standing(body_, {.arm_r = {.raise = 10, .elbow = 10}});
  const Evidence evidence = studio_.Show(body_, truth);
  const PoseState lost = Standing(body_, {});
  ASSERT_FALSE(Recover(studio_.Show(body_, lost), lost)) << "the first look";
  constexpr double kPeriodS = 0.01;
  ASSERT_FALSE(Recover(evidence, lost, kPeriodS));  // The left arm was looked for.
  const std::optional<PoseState> found = Recover(evidence, lost, kPeriodS);
  ASSERT_TRUE(found);
  EXPECT_LT(Error(FitFrom(*found, body_, fit_), truth), 15);
}

TEST_F(Recovery, LostArmsTakeNoMemoryTheSecondTime) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  const ArmStance raised{.raise = 30, .forward = 30, .elbow = 60};
  const ArmStance before_chest{.forward = 40, .elbow = 90};
  const PoseState lost = Standing(body_, {});
  const Evidence one = studio_.Show(body_, Standing(body_, {.arm_l = raised}));
  const Evidence both =
      studio_.Show(body_, Standing(body_, {.arm_l = before_chest, .arm_r = before_chest}));
  const auto look = [&] {
    EXPECT_TRUE(Recover(one, lost));
    EXPECT_TRUE(Recover(both, lost));
  };
  look();
  const std::int64_t before = Allocations();
  EXPECT_GT(before, 0);
  look();
  EXPECT_EQ(Allocations() - before, 0);
}

TEST_F(Recovery, AfterASearchInVainNothingIsSearchedForAWhile) {
  const PoseState truth = Standing(body_, {.arm_l = {.raise = 30, .forward = 30, .elbow = 60}});
  const Evidence evidence = studio_.Show(body_, truth);
  PoseState elsewhere = truth;
  elsewhere.X_WT.p.x() += 1500;
  EXPECT_FALSE(Recover(evidence, elsewhere));
  const PoseState lost = Standing(body_, {});
  EXPECT_FALSE(Recover(evidence, lost, 0.001));
  EXPECT_TRUE(Recover(evidence, lost, 0.05));
}

TEST_F(Recovery, WhoHasAHatIsSearchedAtOnceWhenAnArmIsLostToo) {
  BodySizes sizes = body_.sizes();
  sizes.head += 150;
  const BodyModel with_hat(body_.table(), sizes);
  const PoseState lost = Standing(body_, {});
  const Evidence hat = studio_.Show(with_hat, lost);
  EXPECT_FALSE(Recover(hat, lost));
  fit_.SetEvidence(hat);
  EXPECT_GT(fit_.QualityAt(body_, lost).unexplained_share, 0.005);
  const PoseState truth = Standing(body_, {.arm_l = {.raise = 30, .forward = 30, .elbow = 60}});
  const Evidence evidence = studio_.Show(with_hat, truth);
  const std::optional<PoseState> found = Recover(evidence, lost, 0.01);
  ASSERT_TRUE(found);
  EXPECT_LT(Error(FitFrom(*found, body_, fit_), truth), 15);
}

TEST_F(Recovery, LegsThatTookEachOthersPlaceAreToldApart) {
  constexpr LegStance kFront{.hip = 35, .knee = 15};
  constexpr LegStance kBack{.hip = -15, .knee = 30};
  const PoseState truth = Standing(body_, {.leg_l = kFront, .leg_r = kBack});
  const Evidence evidence = studio_.Show(body_, truth);
  const PoseState exchanged = FitFromStance(evidence, {.leg_l = kBack, .leg_r = kFront});
  ASSERT_GT(Error(exchanged, truth), 40);
  const std::optional<PoseState> found = Recover(evidence, exchanged);
  ASSERT_TRUE(found);
  EXPECT_LT(Error(FitFrom(*found, body_, fit_), truth), 15);
}

TEST_F(Recovery, ForearmsThatCrossedAreNotTakenForHandsThatTouched) {
  constexpr ArmStance kCrossed{.raise = -45, .forward = 100, .twist = 40, .elbow = 40};
  constexpr ArmStance kApart{.raise = -45, .forward = 70, .twist = 0, .elbow = 15};
  const PoseState truth = Standing(body_, {.arm_l = kCrossed, .arm_r = kCrossed});
  const Evidence evidence = studio_.Show(body_, truth);
  const PoseState exchanged = FitFromStance(evidence, {.arm_l = kApart, .arm_r = kApart});
  ASSERT_GT(Error(exchanged, truth), 40);
  ASSERT_LT(fit_.QualityAt(body_, exchanged).unexplained_share, 0.01);
  const std::optional<PoseState> found = Recover(evidence, exchanged);
  ASSERT_TRUE(found);
  EXPECT_LT(Error(FitFrom(*found, body_, fit_), truth), 15);
}

TEST_F(Recovery, LimbsOfABodyThatIsNotDrawnYetStayWhereTheyAre) {
  const PoseState truth = Standing(body_, {.arm_l = kArmOut, .arm_r = {.raise = -80}});
  const Evidence evidence = studio_.Show(body_, truth);
  PoseState late = truth;
  late.X_WT.p += Vector3(90, 40, 0);
  late.X_WT.R = ExpRotation(Vector3(0, 0, 0.2)) * late.X_WT.R;
  fit_.SetEvidence(evidence);
  ASSERT_GT(fit_.QualityAt(body_, late).unexplained_share, 0.01);
  EXPECT_FALSE(Recover(evidence, late));
}

TEST_F(Recovery, AtTheFirstLookCrossedLegsAreToldFromStraightOnesThatLookAlike) {
  constexpr LegStance kFront{.hip = 10, .spread = -8, .knee = 40};
  constexpr LegStance kBack{.hip = -10, .spread = -8, .knee = 40};
  const PoseState truth = Standing(body_, {.leg_l = kFront, .leg_r = kBack});
  const Evidence evidence = studio_.Show(body_, truth);
  const PoseState crossed = FitFromStance(evidence, {.leg_l = kBack, .leg_r = kFront});
  ASSERT_GT(Error(crossed, truth), 40);
  ASSERT_LT(fit_.QualityAt(body_, crossed).unexplained_share, 0.005);
  const std::optional<PoseState> found = Recover(evidence, crossed, 0);
  ASSERT_TRUE(found);
  EXPECT_LT(Error(FitFrom(*found, body_, fit_), truth), 15);
  EXPECT_FALSE(Recover(evidence, crossed, 0));
}

TEST_F(Recovery, NothingIsRecoveredWhereNothingIsLost) {
  const PoseState truth = Standing(body_, {.arm_l = kArmOut, .leg_r = kStep});
  const Evidence evidence = studio_.Show(body_, truth);
  EXPECT_FALSE(Recover(evidence, truth));
}

TEST_F(Recovery, LaterARightPoseIsLeftAlone) {
  const PoseState truth = Standing(body_, {});
  EXPECT_FALSE(RecoverLater(truth, truth, kAtTenHz_s));
}

TEST_F(Recovery, LaterALostArmIsFoundAgain) {
  const PoseState truth = Standing(body_, {.arm_l = {.raise = 30, .forward = 30, .elbow = 60}});
  const std::optional<PoseState> found = RecoverLater(Standing(body_, {}), truth, kAtThirtyHz_s);
  ASSERT_TRUE(found);
  EXPECT_LT(Errors(*found, truth).maxCoeff(), 40);
}

TEST_F(Recovery, LaterBothLegsOfAStrideAreFound) {
  const PoseState truth = Standing(body_, {.leg_l = kAhead, .leg_r = kBehind});
  const std::optional<PoseState> found = RecoverLater(Standing(body_, {}), truth, kAtTenHz_s);
  ASSERT_TRUE(found);
  EXPECT_LT(Errors(*found, truth).maxCoeff(), 40);
}

TEST_F(Recovery, LaterExchangedLegsAreFound) {
  const PoseState truth = Standing(body_, {.leg_l = kAhead, .leg_r = kBehind});
  const PoseState exchanged = Standing(body_, {.leg_l = kBehind, .leg_r = kAhead});
  const std::optional<PoseState> found = RecoverLater(exchanged, truth, kAtTenHz_s);
  ASSERT_TRUE(found);
  EXPECT_LT(Errors(*found, truth).maxCoeff(), 40);
}

TEST_F(Recovery, ASmallGainIsTakenAtOnceOnlyIfFramesAreRare) {
  // In the middle of the room, a bent arm gains between 1.2 and 3 mm.
  const auto in_the_middle = [](PoseState pose) {
    pose.X_WT = {Matrix3::Identity(), {0, 0, pose.X_WT.p.z()}};
    return pose;
  };
  const PoseState hanging = in_the_middle(Standing(body_, {}));
  const PoseState bent = in_the_middle(Standing(body_, {.arm_l = {.elbow = 58}}));
  EXPECT_TRUE(RecoverLater(hanging, bent, kAtTenHz_s));
  recovery_ = LimbRecovery(body_.table());
  EXPECT_FALSE(RecoverLater(hanging, bent, kAtThirtyHz_s));
  EXPECT_TRUE(recovery_.rival());
}

}  // namespace
}  // namespace mocap
