#include "core/hypotheses/steady_pose.h"

#include <gtest/gtest.h>

#include <random>

#include "config/load_config.h"

namespace mocap {
namespace {

constexpr double kFrame_s = 1.0 / 30;
constexpr double kNoiseMm = 1.5, kNoiseRad = 0.003;

// A filter at poses of our choice. It takes noise for larger than it is, as the tracker's does,
// whose contacts are not independent.
class SteadyPoseTest : public ::testing::Test {
 protected:
  PoseFilter FilterAt(const PoseState& pose) const {
    PoseFilter filter{MotionNoise{}};
    filter.Reset(pose, 3 * kNoiseMm, 3 * kNoiseRad);
    return filter;
  }
  PoseState Noisy(PoseState pose) {
    std::normal_distribution<double> mm(0, kNoiseMm), rad(0, kNoiseRad);
    PoseStep step(pose.dof());
    for (int i = 0; i < step.size(); ++i) step[i] = i < 3 ? mm(random_) : rad(random_);
    pose.Add(step);
    return pose;
  }
  PoseState Rest() const {
    PoseState pose;
    pose.X_WT.p = Vector3(100, 200, 1200);
    pose.theta = JointAngles::Zero(std::ssize(body_.table().joints));
    return pose;
  }
  BodyPoints PointsAt(const PoseState& pose) const { return body_.PointsAt(body_.PostureAt(pose)); }
  PoseState Follow(const PoseState& pose, const Contacts& contacts = kUnknownContacts) {
    return steady_.Follow(body_, FilterAt(pose), PointStds::Constant(15), contacts, kFrame_s);
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  SteadyPose steady_;
  std::mt19937 random_{5};
};

TEST_F(SteadyPoseTest, AStillBodyIsStill) {
  double raw_mm = 0, steady_mm = 0;
  PoseState last = Noisy(Rest()), held = Follow(last);
  for (int i = 0; i < 60; ++i) {
    const PoseState pose = Noisy(Rest());
    const PoseState steady = Follow(pose);
    if (i >= 10) {
      raw_mm += (PointsAt(pose) - PointsAt(last)).colwise().norm().mean();
      steady_mm += (PointsAt(steady) - PointsAt(held)).colwise().norm().mean();
    }
    last = pose, held = steady;
  }
  EXPECT_LT(steady_mm, 0.25 * raw_mm);
}

TEST_F(SteadyPoseTest, AHandThatStartsIsFollowedAtOnceAndTheRestStays) {
  PoseState pose = Rest();
  for (int i = 0; i < 10; ++i) Follow(Noisy(pose));
  const PoseState before = Follow(pose);
  for (int i = 0; i < pose.theta.size(); ++i)
    if (body_.table().joints[i].name == "elbow_l_z") pose.theta[i] -= 0.15;
  const PoseState after = Follow(pose);
  const auto moved_mm = [&](Point point) {
    const int i = static_cast<int>(point);
    return (PointsAt(after).col(i) - PointsAt(before).col(i)).norm();
  };
  const int hand = static_cast<int>(Point::kFingertipsL);
  EXPECT_LT((PointsAt(after) - PointsAt(pose)).col(hand).norm(), 15);
  EXPECT_GT(moved_mm(Point::kFingertipsL), 40);
  EXPECT_LT(moved_mm(Point::kFingertipsR), 8);
  EXPECT_LT(moved_mm(Point::kFootL), 8);
}

TEST_F(SteadyPoseTest, AFootThatStandsStaysWhereTheOtherFollows) {
  Contacts left_stands;
  left_stands << 1, 0, 1, 0;
  const auto toe_W = [&](Point toe, const PoseState& pose) {
    return body_.PlaceOf(toe, body_.PostureAt(pose));
  };
  PoseState pose = Rest();
  for (int i = 0; i < 30; ++i) Follow(pose, left_stands);
  const PoseState first = Follow(pose, left_stands);
  // Both legs swing alike.
  for (int j = 0; j < pose.theta.size(); ++j) {
    const std::string& name = body_.table().joints[j].name;
    if (name == "hip_l_y" || name == "hip_r_y") pose.theta[j] -= 0.033;
  }
  const PoseState last = Follow(pose, left_stands);
  const auto way_mm = [&](Point toe) { return (toe_W(toe, last) - toe_W(toe, first)).norm(); };
  EXPECT_GT(way_mm(Point::kToeR), 10);
  EXPECT_LT(way_mm(Point::kToeL), 0.5 * way_mm(Point::kToeR));
}

TEST_F(SteadyPoseTest, AFootThatLeavesIsFree) {
  Contacts stands = Contacts::Ones(), leaves = Contacts::Zero();
  PoseState pose = Rest();
  for (int i = 0; i < 5; ++i) Follow(pose, stands);
  pose.X_WT.p.z() += 60;
  const PoseState raised = Follow(pose, leaves);
  EXPECT_LT((PointsAt(raised) - PointsAt(pose)).colwise().norm().mean(), 2);
}

TEST_F(SteadyPoseTest, AFastMotionIsNotDelayed) {
  PoseState pose = Rest();
  Follow(pose);
  for (int i = 0; i < 10; ++i) {
    pose.X_WT.p.x() += 40;
    const PoseState steady = Follow(pose);
    EXPECT_LT((PointsAt(steady) - PointsAt(pose)).colwise().norm().mean(), 2);
  }
}

TEST_F(SteadyPoseTest, AfterAResetThePoseIsTheFilters) {
  Follow(Rest());
  steady_.Reset();
  PoseState pose = Rest();
  pose.X_WT.p.z() += 1;
  EXPECT_EQ(Follow(pose).X_WT.p, pose.X_WT.p);
}

}  // namespace
}  // namespace mocap
