#include "core/objective/pose_priors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/fitted_body.h"
#include "tests/support/slopes.h"

namespace mocap {
namespace {

constexpr double kDegree = EIGEN_PI / 180;

class PosePriors : public FittedBody {
 protected:
  /// Somebody upright, turned about the vertical.
  PoseState Turned(double degrees) const {
    PoseState pose = Standing({});
    pose.X_WT.R = ExpRotation(Vector3(0, 0, degrees * kDegree));
    return pose;
  }
  /// Somebody upright, turned over about the axis across.
  PoseState Tilted(double degrees) const {
    PoseState pose = Standing({});
    pose.X_WT.R = ExpRotation(Vector3(0, degrees * kDegree, 0));
    return pose;
  }
  double Habit(const PoseState& pose, const std::optional<Vector3>& toes_W = {}) const {
    return HabitNats(body_, pose, toes_W);
  }
  double HabitOf(double stature_mm) const {
    return HabitNats(BodyModel(body_.table(), AverageSizes(stature_mm)), Standing({}), {});
  }
  void ExpectJointsLinearised(const PoseState& pose) const {
    const PoseStep gradient = GradientOf(body_, pose, [&](const PosedBody&, auto& sums) {
      LinearizeJoints(body_.table(), pose, sums.equations);
    });
    const auto nats = [&](const PoseState& at) { return JointNats(body_.table(), at.theta); };
    ExpectOpposite(gradient, SlopeOf(nats, pose), 1e-5);
  }

  const Vector3 ahead_{40, 0, 0}, behind_{-40, 0, 0};
};

TEST_F(PosePriors, OfJointsDescendWhatTheyCost) {
  PoseState pose = Standing({.arm_l = kArmOut, .arm_r = {.raise = 60}, .leg_r = kStep});
  for (int i = 0; i < pose.theta.size(); ++i) pose.theta[i] += 0.02 * std::sin(5.0 * i);
  ExpectJointsLinearised(pose);
}

TEST_F(PosePriors, OfJointsBeyondTheirLimitsDescendWhatTheyCost) {
  PoseState pose = Standing({});
  for (int i = 0; i < pose.theta.size(); ++i) {
    const JointAxis& joint = body_.table().joints[i];
    pose.theta[i] = i % 2 == 0 ? joint.max_rad + 0.1 : joint.min_rad - 0.1;
  }
  ExpectJointsLinearised(pose);
}

TEST_F(PosePriors, AJointBeyondItsLimitCostsMoreThanOneAtIt) {
  for (int i = 0; i < body_.joint_count(); ++i) {
    const JointAxis& joint = body_.table().joints[i];
    PoseState pose = Standing({});
    pose.theta[i] = joint.max_rad;
    const double at_limit = JointNats(body_.table(), pose.theta);
    pose.theta[i] += 5 * kDegree;
    EXPECT_GT(JointNats(body_.table(), pose.theta), at_limit + std::log(1000)) << joint.name;
  }
}

TEST_F(PosePriors, FeetTellHowFarATrunkIsTurned) {
  EXPECT_NEAR(ShareBackwards(Turned(180), behind_), 0, 1e-9);
  EXPECT_NEAR(ShareBackwards(Turned(0), behind_), 1, 1e-9);
}

TEST_F(PosePriors, AnUprightTrunkCostsMoreTheFartherItIsTurnedFromTheFeet) {
  const double ahead = Habit(Turned(0), ahead_), opposite = Habit(Turned(180), ahead_) - ahead;
  EXPECT_NEAR(ahead, Habit(Turned(0)), 1e-9);
  EXPECT_LE(Habit(Turned(60), ahead_) - ahead, 0.26 * opposite);
  EXPECT_GT(opposite, std::log(19)) << "or else feet decide nothing";
  for (double degrees = 0; degrees < 180; degrees += 20)
    EXPECT_LT(Habit(Turned(degrees), ahead_), Habit(Turned(degrees + 20), ahead_));
  EXPECT_LT(ShareBackwards(Turned(80), ahead_), 0.5);
  EXPECT_GT(ShareBackwards(Turned(100), ahead_), 0.5);
}

TEST_F(PosePriors, WhoLiesOrHasNoFeetIsLeftAlone) {
  const double without_feet = Habit(Tilted(-90));
  for (const Vector3& toes_W : {ahead_, behind_})
    EXPECT_NEAR(Habit(Tilted(-90), toes_W), without_feet, 1e-9);
  EXPECT_EQ(ShareBackwards(Turned(180), {}), 0);
  EXPECT_EQ(Habit(Turned(180)), Habit(Turned(0)));
}

TEST_F(PosePriors, UpsideDownIsImprobable) {
  double last = Habit(Tilted(0));
  for (double degrees = 30; degrees <= 180; degrees += 30) {
    EXPECT_GT(Habit(Tilted(degrees)), last) << degrees;
    last = Habit(Tilted(degrees));
  }
  EXPECT_GT(last - Habit(Tilted(0)), std::log(100));
}

TEST_F(PosePriors, GiantsCostMoreThanChildren) {
  EXPECT_EQ(HabitOf(1100), HabitOf(1750));
  EXPECT_LT(HabitOf(1900), HabitOf(1750) + 1);
  EXPECT_GT(HabitOf(2050), HabitOf(1750) + 4);
}

TEST_F(PosePriors, TwistsOfWhoFacesTheOppositeWayCost) {
  const ArmStance reaching{.raise = -60, .forward = 50, .elbow = 40};
  PoseState truth = Standing({.arm_l = reaching, .arm_r = reaching, .leg_l = {}, .leg_r = {}});
  truth.X_WT = {Matrix3::Identity(), Vector3(0, 0, truth.X_WT.p.z())};
  See(truth);
  const auto nats = [&](double yaw) {
    PoseState start = truth;
    start.X_WT.R = ExpRotation(Vector3(0, 0, yaw));
    return JointNats(body_.table(), HypothesisAt(start).filter.pose().theta);
  };
  const double of_truth = JointNats(body_.table(), truth.theta);
  EXPECT_LT(3 * (nats(0) - of_truth), nats(EIGEN_PI) - of_truth);
}

}  // namespace
}  // namespace mocap
