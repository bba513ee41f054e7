#include "core/objective/keypoint_term.h"

#include <gtest/gtest.h>

#include "tests/support/fitted_body.h"
#include "tests/support/keypoints_of_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

constexpr double kTurn_rad = 3.1415926535;

class KeypointTermTest : public FittedBody {
 protected:
  double At(const PoseState& pose) const {
    PosedBody posed;
    posed.Set(body_, pose);
    return term_.At(posed);
  }
  void Look(const PoseState& truth) {
    views_ = {KeypointsOf(body_, truth, {3000, 500, 1500}),
              KeypointsOf(body_, truth, {-1000, 3000, 2500})};
    term_.SetEvidence(views_);
  }
  PoseState TurnedAbout(PoseState pose) const {
    pose.X_WT.R = ExpRotation(Vector3(0, 0, kTurn_rad)) * pose.X_WT.R;
    return pose;
  }

  PoseState truth_ = Standing({.arm_l = kArmOut, .leg_l = kStep});
  std::vector<KeypointRays> views_;
  KeypointTerm term_;
};

TEST_F(KeypointTermTest, CostsNothingWithoutViews) { EXPECT_EQ(At(truth_), 0); }

TEST_F(KeypointTermTest, DescendsWhatItCosts) {
  Look(truth_);
  for (const double share : {0.5, 1.0}) {
    const PoseState pose = Off(truth_, share);
    const PoseStep gradient = GradientOf(
        body_, pose, [&](const PosedBody& posed, auto& sums) { term_.Linearize(posed, sums); });
    ExpectOpposite(gradient, SlopeOf([&](const PoseState& at) { return At(at); }, pose), 1e-4);
  }
}

TEST_F(KeypointTermTest, DescendsAlsoWhereSidesAreExchanged) {
  Look(truth_);
  for (KeypointRays& view : views_)
    for (KeypointRay& ray : view.rays) ray.landmark = Mirrored(ray.landmark);
  const PoseState pose = Off(truth_, 0.5);
  const PoseStep gradient = GradientOf(
      body_, pose, [&](const PosedBody& posed, auto& sums) { term_.Linearize(posed, sums); });
  ExpectOpposite(gradient, SlopeOf([&](const PoseState& at) { return At(at); }, pose), 1e-4);
}

TEST_F(KeypointTermTest, CostsLeastAtTheTruth) {
  Look(truth_);
  const double right = At(truth_);
  EXPECT_GT(At(Off(truth_)), right + 1);
  EXPECT_GT(At(TurnedAbout(truth_)), right + 3);
}

TEST_F(KeypointTermTest, ViewsOfSomethingElseCostNoMoreThanThat) {
  Look(truth_);
  PoseState far = truth_;
  far.X_WT.p += Vector3(800, 0, 0);
  const double once = At(far);
  far.X_WT.p += Vector3(4000, 0, 0);
  EXPECT_NEAR(At(far), once, 0.05 * once);
  PosedBody posed;
  posed.Set(body_, far);
  EXPECT_GT(KeypointTerm::ProbabilityOfElsewhere(views_[0], posed), 0.99);
  posed.Set(body_, truth_);
  EXPECT_GT(KeypointTerm::ProbabilityOfRight(views_[0], posed), 0.9);
}

TEST_F(KeypointTermTest, ViewsOfMoreWorthCostMore) {
  Look(truth_);
  const double once = At(Off(truth_));
  for (KeypointRays& view : views_) view.worth = 3;
  EXPECT_NEAR(At(Off(truth_)), 3 * once, 1e-9);
}

}  // namespace
}  // namespace mocap
