#include "core/proposals/scheduler.h"

#include <gtest/gtest.h>

#include "tests/support/fitted_body.h"

namespace mocap {
namespace {

constexpr double kAtThirtyHz_s = 1.0 / 30;
constexpr double kAtTenHz_s = 0.1;

class Schedule : public FittedBody {
 protected:
  /// Somebody is believed to be in a pose.
  HypothesisSet Believing(const PoseState& pose) {
    Hypothesis believed(body_, pose, false);
    believed.things = kAnyThings;
    believed.Fit(objective_);
    HypothesisSet set;
    set.Begin({believed});
    return set;
  }
  void Try(HypothesisSet& set, double dt_s) { scheduler_.Try(objective_, set, true, dt_s); }
  /// Follows still evidence. By default as long as it takes to try all that is tried.
  void Follow(HypothesisSet& set, double period_s, double time_s = 1) {
    for (double t_s = 0; t_s < time_s; t_s += period_s) {
      set.Follow(objective_, period_s);
      Try(set, period_s);
    }
  }
  /// How far off is who is believed, a time after the pose was lost.
  double ErrorAfter(const PoseState& lost, const PoseState& truth, double period_s,
                    double time_s = 1) {
    See(truth);
    HypothesisSet set = Believing(lost);
    Follow(set, period_s, time_s);
    return Error(set.best().filter.pose(), truth);
  }
  double Facing(const HypothesisSet& set, const PoseState& truth) const {
    return set.best().filter.pose().X_WT.R.col(0).dot(truth.X_WT.R.col(0));
  }
  static PoseState TurnedAbout(PoseState pose) {
    pose.X_WT.R = pose.X_WT.R * ExpRotation(Vector3(0, 0, EIGEN_PI));
    return pose;
  }
  /// A body whose head explains a hat.
  BodyModel WithHat() const {
    BodySizes sizes = body_.sizes();
    sizes.head += 150;
    return BodyModel(body_.table(), sizes);
  }

  static constexpr ArmStance kRaised{.raise = 30, .forward = 30, .elbow = 60};
  static constexpr LegStance kAhead{.hip = 45, .spread = 5, .knee = 20};
  static constexpr LegStance kBehind{.hip = -20, .spread = 5, .knee = 80};
  Scheduler scheduler_{body_.table()};
};

TEST_F(Schedule, ALostArmIsFoundAgain) {
  const PoseState truth = Standing({.arm_l = kRaised});
  EXPECT_LT(ErrorAfter(Standing({}), truth, kAtTenHz_s), 15);
}

TEST_F(Schedule, ALostArmIsFoundAgainAtAnyRate) {
  const PoseState truth = Standing({.arm_r = {.raise = 10, .elbow = 10}});
  EXPECT_LT(ErrorAfter(Standing({}), truth, kAtThirtyHz_s), 15);
  scheduler_.StartOver();
  EXPECT_LT(ErrorAfter(Standing({}), truth, 0.01), 15);
}

TEST_F(Schedule, BothLegsOfAStrideAreFound) {
  const PoseState truth = Standing({.leg_l = kAhead, .leg_r = kBehind});
  EXPECT_LT(ErrorAfter(Standing({}), truth, kAtTenHz_s), 15);
}

TEST_F(Schedule, LegsThatTookEachOthersPlaceAreToldApart) {
  constexpr LegStance kFront{.hip = 35, .knee = 15};
  constexpr LegStance kBack{.hip = -15, .knee = 30};
  const PoseState truth = Standing({.leg_l = kFront, .leg_r = kBack});
  See(truth);
  const PoseState exchanged = FitFrom(Standing({.leg_l = kBack, .leg_r = kFront}));
  ASSERT_GT(Error(exchanged, truth), 40);
  EXPECT_LT(ErrorAfter(exchanged, truth, kAtTenHz_s), 15);
}

TEST_F(Schedule, ARightPoseIsLeftAlone) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  for (const double period_s : {kAtThirtyHz_s, kAtTenHz_s}) {
    scheduler_.StartOver();
    EXPECT_LT(ErrorAfter(truth, truth, period_s), 8);
  }
}

TEST_F(Schedule, WhereNothingIsInDoubtNothingIsSpent) {
  See(Standing({.arm_l = kArmOut, .leg_r = kStep}));
  HypothesisSet set = Believing(Standing({.arm_l = kArmOut, .leg_r = kStep}));
  const double before = objective_.evaluations();
  for (int i = 0; i < 10; ++i) Try(set, kAtTenHz_s);
  EXPECT_EQ(objective_.evaluations(), before);
  EXPECT_EQ(set.all().size(), 1u);
}

TEST_F(Schedule, ABodyThatLagsIsDrawnAndItsLimbsStay) {
  const PoseState truth = Standing({.arm_l = kArmOut, .arm_r = {.raise = -80}});
  PoseState late = truth;
  late.X_WT.p += Vector3(90, 40, 0);
  late.X_WT.R = ExpRotation(Vector3(0, 0, 0.2)) * late.X_WT.R;
  See(truth);
  ASSERT_GT(At(late).unexplained_share, 0.01);
  EXPECT_LT(ErrorAfter(late, truth, kAtTenHz_s, 0.1), 15);
}

TEST_F(Schedule, ABudgetIsOfTimeAndNotOfFrames) {
  // Flesh that no part ever explains.
  const PoseState truth = Standing({});
  See(WithHat(), truth);
  const auto spent = [&](double period_s) {
    scheduler_.StartOver();
    HypothesisSet set = Believing(truth);
    double sum = 0;
    for (double t_s = 0; t_s < 1; t_s += period_s) {
      const double before = objective_.evaluations();
      Try(set, period_s);
      sum += objective_.evaluations() - before;
    }
    return sum;
  };
  const double often = spent(0.01), rarely = spent(kAtTenHz_s);
  EXPECT_GT(rarely, 0);
  EXPECT_NEAR(often, rarely, 0.35 * rarely);
}

TEST_F(Schedule, FramesThatFollowEachOtherFastShareARound) {
  const PoseState truth = Standing({});
  See(WithHat(), truth);
  const auto most = [&](double period_s) {
    scheduler_.StartOver();
    HypothesisSet set = Believing(truth);
    double peak = 0;
    for (int i = 0; i < 5; ++i) {
      const double before = objective_.evaluations();
      Try(set, period_s);
      peak = std::max(peak, objective_.evaluations() - before);
    }
    return peak;
  };
  EXPECT_LT(most(0.005), 0.7 * most(0.2));
}

TEST_F(Schedule, AfterARoundInVainNothingIsTriedForAWhile) {
  const PoseState truth = Standing({});
  See(WithHat(), truth);
  HypothesisSet set = Believing(truth);
  ASSERT_GT(set.best().fitness.unexplained_share, 0.005);
  for (int i = 0; i < 3; ++i) Try(set, kAtTenHz_s);
  const double before = objective_.evaluations();
  Try(set, 0.001);
  EXPECT_EQ(objective_.evaluations(), before);
  for (int i = 0; i < 10; ++i) Try(set, kAtTenHz_s);
  EXPECT_GT(objective_.evaluations(), before) << "later it is";
}

TEST_F(Schedule, WhoHasAHatIsLookedAtAtOnceWhenAnArmIsLostToo) {
  const PoseState lost = Standing({}), truth = Standing({.arm_l = kRaised});
  See(WithHat(), lost);
  HypothesisSet set = Believing(lost);
  for (int i = 0; i < 3; ++i) Try(set, kAtTenHz_s);
  ASSERT_GT(set.best().fitness.unexplained_share, 0.005);
  ASSERT_LT(Error(set.best().filter.pose(), lost), 20);
  See(WithHat(), truth);
  Follow(set, kAtThirtyHz_s, 0.3);
  EXPECT_LT(Error(set.best().filter.pose(), truth), 25);
}

TEST_F(Schedule, WhoFacesBackwardsIsTurned) {
  const PoseState truth = Standing({.arm_l = {.forward = 30}, .arm_r = {.forward = 20}});
  See(truth);
  evidence_.toes_W = truth.X_WT.R.col(0);
  HypothesisSet set = Believing(TurnedAbout(truth));
  ASSERT_LT(Facing(set, truth), -0.9);
  Follow(set, kAtTenHz_s, 0.5);
  EXPECT_GT(Facing(set, truth), 0.9);
  EXPECT_LT(Error(set.best().filter.pose(), truth), 20);
}

TEST_F(Schedule, NobodyIsTurnedByOneWrongLookAtTheFeetAfterAGap) {
  const PoseState truth = Standing({.arm_l = {.forward = 30}, .arm_r = {.forward = 20}});
  See(truth);
  evidence_.toes_W = truth.X_WT.R.col(0);
  HypothesisSet set = Believing(truth);
  Follow(set, kAtTenHz_s, 0.2);
  evidence_.toes_W = -truth.X_WT.R.col(0);
  set.Follow(objective_, 3);
  Try(set, 3);
  EXPECT_GT(Facing(set, truth), 0.9);
}

TEST_F(Schedule, TheSameInputGivesTheSameBits) {
  const PoseState truth = Standing({.arm_l = kRaised});
  See(truth);
  HypothesisSet one = Believing(Standing({})), other = one;
  Scheduler again(body_.table());
  for (int i = 0; i < 3; ++i) {
    one.Follow(objective_, kAtTenHz_s);
    Try(one, kAtTenHz_s);
    other.Follow(objective_, kAtTenHz_s);
    again.Try(objective_, other, true, kAtTenHz_s);
  }
  ASSERT_EQ(one.all().size(), other.all().size());
  EXPECT_EQ(one.best().filter.pose().theta, other.best().filter.pose().theta);
  EXPECT_EQ(one.best().nats, other.best().nats);
}

}  // namespace
}  // namespace mocap
