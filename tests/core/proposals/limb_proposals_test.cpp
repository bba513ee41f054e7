#include "core/proposals/limb_proposals.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/allocation_counter.h"
#include "tests/support/fitted_body.h"

namespace mocap {
namespace {

class Proposed : public FittedBody {
 protected:
  /// The mean error of the pose that the evidence prefers, after a fit.
  double BestError(const PoseState& truth) {
    const auto nats = [&](const PoseState& pose) { return At(FitFrom(pose)).Sum(); };
    return Error(FitFrom(*std::ranges::min_element(poses_, {}, nats)), truth);
  }
  Hypothesis Unfitted(const PoseState& pose) const { return {body_, pose, false}; }
  /// Somebody who stands, but has the torso where it truly is.
  Hypothesis Upright(const PoseState& truth) const {
    PoseState pose = Standing({});
    pose.X_WT = truth.X_WT;
    return Unfitted(pose);
  }

  static constexpr ArmStance kRaised{.raise = 30, .forward = 30, .elbow = 60};
  static constexpr LegStance kAhead{.hip = 45, .spread = 5, .knee = 20};
  static constexpr LegStance kBehind{.hip = -20, .spread = 5, .knee = 80};
  LimbProposals proposals_{body_.table()};
  std::vector<PoseState> poses_;
};

TEST_F(Proposed, ALostArmIsWhereTheEvidenceIs) {
  const PoseState truth = Standing({.arm_l = kRaised});
  See(truth);
  proposals_.Elsewhere(objective_, Upright(truth), Segment::kHandL, poses_);
  ASSERT_FALSE(poses_.empty());
  EXPECT_LT(Error(FitFrom(poses_.front()), truth), 15) << "the first is the best";
}

TEST_F(Proposed, ALostLegIsWhereTheEvidenceIs) {
  const PoseState truth = Standing({.leg_r = {.hip = 60, .knee = 60}});
  See(truth);
  proposals_.Elsewhere(objective_, Upright(truth), Segment::kToesR, poses_);
  ASSERT_FALSE(poses_.empty());
  EXPECT_LT(BestError(truth), 15);
}

TEST_F(Proposed, OnlyTheLimbDiffersAndItsEndIsElsewhere) {
  See(Standing({.arm_l = kRaised}));
  const PoseState present = Standing({.arm_r = kArmOut, .leg_l = kStep});
  proposals_.Elsewhere(objective_, Unfitted(present), Segment::kHandL, poses_);
  ASSERT_FALSE(poses_.empty());
  for (const PoseState& pose : poses_) {
    EXPECT_EQ(pose.X_WT.p, present.X_WT.p);
    for (int i = 0; i < pose.theta.size(); ++i) {
      if (!body_.table().Carries(i, Segment::kHandL) || body_.table().Carries(i, Segment::kHandR)) {
        EXPECT_EQ(pose.theta[i], present.theta[i]) << body_.table().joints[i].name;
      }
    }
    EXPECT_GT(Errors(pose, present)[static_cast<int>(Point::kFingertipsL)], 50);
  }
}

TEST_F(Proposed, BothLegsOfAStrideAreFound) {
  const PoseState truth = Standing({.leg_l = kAhead, .leg_r = kBehind});
  See(truth);
  proposals_.Both(objective_, Upright(truth), kLimbPairs[1], poses_);
  ASSERT_FALSE(poses_.empty());
  EXPECT_LT(BestError(truth), 15);
}

TEST_F(Proposed, BothArmsBeforeTheChestAreFound) {
  constexpr ArmStance kBeforeChest{.forward = 40, .elbow = 90};
  const PoseState truth = Standing({.arm_l = kBeforeChest, .arm_r = kBeforeChest});
  See(truth);
  proposals_.Both(objective_, Upright(truth), kLimbPairs[0], poses_);
  EXPECT_LT(BestError(truth), 15);
}

TEST_F(Proposed, TakeNoMemoryTheSecondTime) {
  if (!kCountsAllocations) GTEST_SKIP() << "the sanitizer allocates by itself";
  const Hypothesis lost = Unfitted(Standing({}));
  See(Standing({.arm_l = kRaised, .leg_r = kStep}));
  const auto propose = [&] {
    poses_.clear();
    for (const Segment end : kLimbEnds) proposals_.Elsewhere(objective_, lost, end, poses_);
    for (const LimbPair& pair : kLimbPairs) proposals_.Both(objective_, lost, pair, poses_);
  };
  propose();
  const std::int64_t before = Allocations();
  EXPECT_GT(before, 0);
  propose();
  EXPECT_EQ(Allocations() - before, 0);
}

}  // namespace
}  // namespace mocap
