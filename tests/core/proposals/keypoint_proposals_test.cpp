#include "core/proposals/keypoint_proposals.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/fitted_body.h"
#include "tests/support/keypoints_of_body.h"

namespace mocap {
namespace {

class KeypointProposals : public FittedBody {
 protected:
  KeypointProposals() {
    See(truth_);
    views_ = {KeypointsOf(body_, truth_, {3000, 500, 1500}),
              KeypointsOf(body_, truth_, {-1000, 3000, 2500})};
  }
  PoseState Turned(int axis) const {
    PoseState pose = truth_;
    pose.X_WT.R = pose.X_WT.R * ExpRotation(std::numbers::pi * Vector3::Unit(axis));
    return pose;
  }

  PoseState truth_ = Standing({.arm_l = kArmOut, .leg_l = kStep});
  std::vector<KeypointRays> views_;
};

TEST_F(KeypointProposals, FindWhoIsTurnedAboutOrUpsideDown) {
  for (const int axis : {0, 1, 2}) {
    const Hypothesis wrong(body_, Turned(axis), false);
    const auto proposed = ProposeByKeypoints(objective_, wrong, views_);
    ASSERT_TRUE(proposed) << axis;
    EXPECT_LT(Error(*proposed, truth_), 20) << axis;
  }
}

TEST_F(KeypointProposals, AreNoneWhereThePoseIsRight) {
  EXPECT_FALSE(ProposeByKeypoints(objective_, Hypothesis(body_, truth_, false), views_));
}

TEST_F(KeypointProposals, AreNoneWithoutViews) {
  EXPECT_FALSE(ProposeByKeypoints(objective_, Hypothesis(body_, Turned(2), false), {}));
}

}  // namespace
}  // namespace mocap
