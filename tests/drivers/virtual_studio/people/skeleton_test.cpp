#include "drivers/virtual_studio/people/skeleton.h"

#include <gtest/gtest.h>

#include "drivers/virtual_studio/motions/gait.h"

namespace mocap::simulation {
namespace {

TruePoints PointsIn(const Anthropometry& body, const BodyPose& pose) {
  return PointsOf(body, PlaceBones(body, pose));
}

const Vector3& At(const TruePoints& points, TruthPoint point, int side = 0) {
  return points[static_cast<int>(point) + side];
}

TEST(Skeleton, JointsBendTheWayPeopleDo) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  const TruePoints upright = PointsIn(body, {});
  for (const int side : {kLeft, kRight}) {
    BodyPose pose;
    pose.legs[side].knee = 0.5;
    EXPECT_LT(At(PointsIn(body, pose), TruthPoint::kAnkleL, side).x(), -100) << "heel back";
    pose = {};
    pose.legs[side].flexion = 0.5;
    EXPECT_GT(At(PointsIn(body, pose), TruthPoint::kKneeL, side).x(), 100) << "thigh forward";
    pose = {};
    pose.legs[side].ankle = 0.3;
    EXPECT_GT(At(PointsIn(body, pose), TruthPoint::kToeL, side).z(),
              At(upright, TruthPoint::kToeL, side).z() + 20)
        << "toes up";
    pose = {};
    pose.arms[side].elbow = 0.5;
    EXPECT_GT(At(PointsIn(body, pose), TruthPoint::kWristL, side).x(), 50) << "forearm forward";
    pose = {};
    pose.arms[side].abduction = 1.0;
    EXPECT_GT(SideSign(side) * At(PointsIn(body, pose), TruthPoint::kElbowL, side).y(),
              SideSign(side) * At(upright, TruthPoint::kElbowL, side).y() + 150)
        << "arm out";
  }
  BodyPose pose;
  pose.lumbar.flexion = 0.5;
  EXPECT_GT(At(PointsIn(body, pose), TruthPoint::kHead).x(), 200) << "trunk forward";
}

TEST(Skeleton, TheLeftLiesOnTheLeft) {
  const TruePoints points = PointsIn(MakeAnthropometry(1750, 1), {});
  for (const TruthPoint point : {TruthPoint::kShoulderL, TruthPoint::kHipL, TruthPoint::kKneeL}) {
    EXPECT_GT(At(points, point, kLeft).y(), 50);
    EXPECT_LT(At(points, point, kRight).y(), -50);
  }
}

TEST(Skeleton, ALegReachesItsTarget) {
  const Anthropometry body = MakeAnthropometry(1600, 2);
  for (const int side : {kLeft, kRight}) {
    for (const double pitch : {-0.3, 0.0, 0.6}) {
      BodyPose pose;
      pose.p_WPelvis = {100, -200, 0.85 * body.hip_height_mm()};
      pose.R_WPelvis = Eigen::AngleAxisd(0.4, Vector3::UnitZ()).toRotationMatrix();
      const FootTarget target = RollFoot(body, {180, -220 + SideSign(side) * 90, 0}, 0.5, pitch);
      PlaceLeg(body, side, target, pose);
      const BonePoses bones = PlaceBones(body, pose);
      EXPECT_LT((bones[kFootL + side].p - target.p_WAnkle).norm(), 1e-6);
      EXPECT_LT((bones[kFootL + side].R - target.R_WFoot).norm(), 1e-9);
    }
  }
}

TEST(Skeleton, AFootOutOfReachIsApproachedWithTheLegStraight) {
  const Anthropometry body = MakeAnthropometry(1600, 2);
  BodyPose pose;
  pose.p_WPelvis.z() = 2 * body.hip_height_mm();
  PlaceLeg(body, kLeft, RollFoot(body, {0, 80, 0}, 0, 0), pose);
  EXPECT_LT(pose.legs[kLeft].knee, 0.05);
  EXPECT_GE(pose.legs[kLeft].knee, 0);
}

TEST(Skeleton, ARolledFootStandsOnItsHeelOrOnFlatToes) {
  const Anthropometry body = MakeAnthropometry(1750, 1);
  for (const double pitch : {-0.3, -0.15, 0.4, 0.9}) {
    BodyPose pose;
    pose.p_WPelvis.z() = 0.9 * body.hip_height_mm();
    PlaceLeg(body, kLeft, RollFoot(body, {0, body.hip_half_mm, 0}, 0, pitch), pose);
    const BonePoses bones = PlaceBones(body, pose);
    const RigidTransform& foot = bones[kFootL];
    const RigidTransform& toes = bones[kToesL];
    if (pitch < 0) {
      EXPECT_NEAR((foot * Vector3(-0.8 * body.heel_mm, 0, -body.ankle_to_sole_mm)).z(), 0, 0.5);
      EXPECT_GT(toes.p.z(), 0.02 * body.stature_mm);
    } else {
      EXPECT_NEAR(toes.p.z(), 0.012 * body.stature_mm, 0.5);
      EXPECT_NEAR((toes.R - Matrix3::Identity()).norm(), 0, 1e-6);
    }
  }
}

}  // namespace
}  // namespace mocap::simulation
