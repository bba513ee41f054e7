#include "core/proposals/limb_objective.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/fitted_body.h"

namespace mocap {
namespace {

class Limb : public FittedBody {
 protected:
  void Begin(const PoseState& pose, Segment end, Segment absent, const Things& things = {}) {
    limb_.Begin(objective_, body_, pose, end, absent, things);
  }

  LimbObjective limb_;
};

// Far from all others, so that none explains what the arm does.
TEST_F(Limb, CostsMoreByWhatTheWholeBodyCostsMore) {
  const PoseState truth = Standing({.arm_l = {.raise = 5, .elbow = 10}});
  See(truth);
  Begin(truth, Segment::kHandL, Segment::kHandL);
  const double limb = limb_.At(truth), whole = At(truth).Sum();
  for (const ArmStance& arm :
       {ArmStance{.raise = 12, .elbow = 10}, ArmStance{.raise = 0, .elbow = 40},
        ArmStance{.raise = 5, .forward = 20, .elbow = 10}}) {
    PoseState moved = truth;
    const PoseState stance = Standing({.arm_l = arm});
    for (const int row : limb_.rows()) moved.theta[row] = stance.theta[row];
    const double more = At(moved).Sum() - whole;
    ASSERT_GT(more, 10);
    EXPECT_NEAR(limb_.At(moved) - limb, more, 0.01 * more) << arm.raise;
  }
}

TEST_F(Limb, IsMovedByItsJointsAloneAndTheEndIsLast) {
  See(Standing({}));
  for (const Segment end : {Segment::kHandL, Segment::kHandR, Segment::kFootL, Segment::kFootR}) {
    Begin(Standing({}), end, end);
    const BodyTable& table = body_.table();
    ASSERT_FALSE(limb_.rows().empty());
    EXPECT_EQ(limb_.rows().back(), table.carrier[static_cast<int>(end)]);
    for (const int row : limb_.rows()) EXPECT_TRUE(table.Carries(row, end));
    EXPECT_TRUE(std::ranges::is_sorted(limb_.rows()));
  }
}

TEST_F(Limb, IsRefinedWithoutTheRest) {
  const PoseState truth = Standing({.arm_l = kArmOut, .leg_r = kStep});
  See(truth);
  PoseState pose = Standing({.arm_l = {.raise = -5, .forward = 30, .elbow = 30}, .leg_r = kStep});
  const PoseState start = pose;
  Begin(pose, Segment::kHandL, Segment::kHandL);
  const double before = limb_.At(pose);
  limb_.Refine(pose);
  EXPECT_LT(limb_.At(pose), before);
  EXPECT_LT(Error(pose, truth), 15);
  EXPECT_EQ(pose.X_WT.p, start.X_WT.p);
  EXPECT_EQ(pose.X_WT.R, start.X_WT.R);
  for (int i = 0; i < pose.theta.size(); ++i) {
    if (std::ranges::find(limb_.rows(), i) == limb_.rows().end()) {
      EXPECT_EQ(pose.theta[i], start.theta[i]) << body_.table().joints[i].name;
    }
  }
}

TEST_F(Limb, EndsAtTheFingersOrToes) {
  const PoseState pose = Standing({.arm_l = kArmOut, .leg_r = kStep});
  See(pose);
  const BodyPoints points_W = body_.PointsAt(body_.PostureAt(pose));
  Begin(pose, Segment::kHandL, Segment::kHandL);
  EXPECT_LT((limb_.TipAt(pose) - points_W.col(static_cast<int>(Point::kFingertipsL))).norm(), 60);
  const Vector3 hand_W = limb_.TipAt(pose);
  PoseState raised = pose;
  raised.theta[limb_.rows().front()] += 0.5;
  EXPECT_GT((limb_.TipAt(raised) - hand_W).norm(), 50);
  EXPECT_EQ(limb_.TipAt(pose), hand_W) << "back again";
}

// Both arms are lost: each may take what the other left.
TEST_F(Limb, MayTakeWhatAnAbsentLimbWouldExplain) {
  const PoseState truth = Standing({.arm_l = {.raise = 0}, .arm_r = {.raise = 0}});
  See(truth);
  Begin(truth, Segment::kHandL, Segment::kHandL);
  const double beside_the_other = limb_.At(truth);
  Begin(truth, Segment::kHandL, Segment::kHandR);
  EXPECT_GT(limb_.At(truth), beside_the_other + 10) << "the other arm's evidence is left open";
}

TEST_F(Limb, IsNoHat) {
  BodySizes sizes = body_.sizes();
  sizes.head += 150;
  const PoseState pose = Standing({});
  See(BodyModel(body_.table(), sizes), pose);
  Things hat;
  hat.set(static_cast<int>(Thing::kHat));
  Begin(pose, Segment::kHandL, Segment::kHandL);
  const double without = limb_.At(pose);
  Begin(pose, Segment::kHandL, Segment::kHandL, hat);
  EXPECT_LT(limb_.At(pose), without) << "nothing to reach for";
}

}  // namespace
}  // namespace mocap
