#include "core/body/foot_contacts.h"

#include <gtest/gtest.h>

#include "config/load_config.h"
#include "core/body/stance.h"
#include "tests/support/standing_height.h"

namespace mocap {
namespace {

constexpr double kFrame_s = 1.0 / 30;
enum Foot { kHeelOfLeft, kHeelOfRight, kToesOfLeft, kToesOfRight };

class FootContactsTest : public ::testing::Test {
 protected:
  /// Standing upright; the lowest flesh touches the floor.
  PoseState Standing() const {
    PoseState pose;
    pose.theta = AnglesOf(Stance{}, body_.table());
    PutOnFloor(body_, pose);
    return pose;
  }
  Contacts Update(const PoseState& pose, double dt_s = kFrame_s) {
    return feet_.Update(body_, body_.PostureAt(pose), dt_s);
  }
  PoseState Turned(PoseState pose, std::string_view joint, double rad) const {
    for (int i = 0; i < body_.joint_count(); ++i)
      if (body_.table().joints[i].name == joint) pose.theta[i] += rad;
    return pose;
  }

  BodyModel body_{LoadBodyTable("full"), AverageSizes(1750)};
  FootContacts feet_;
};

TEST_F(FootContactsTest, FeetThatStandTouchTheFloor) {
  Update(Standing());
  EXPECT_GT(Update(Standing()).minCoeff(), 0.85);
}

TEST_F(FootContactsTest, FeetInTheAirDoNot) {
  PoseState pose = Standing();
  pose.X_WT.p.z() += 100;
  Update(pose);
  EXPECT_LT(Update(pose).maxCoeff(), 0.2);
}

TEST_F(FootContactsTest, FeetThatSlideAlongTheFloorDoNot) {
  PoseState pose = Standing();
  for (int i = 0; i < 10; ++i) {
    Update(pose);
    pose.X_WT.p.x() += 1500 * kFrame_s;
  }
  EXPECT_LT(Update(pose).maxCoeff(), 0.5);
}

TEST_F(FootContactsTest, ARaisedHeelLeavesAndItsToesStay) {
  // The knee bends forward and the toes stay level; the foot turns about its ball.
  PoseState pose = Turned(Standing(), "ankle_l_y", 0.6);
  pose = Turned(pose, "toes_l_y", -0.6);
  const auto ball_W = [&](const PoseState& at) {
    return body_.PlaceOf(Point::kBallL, body_.PostureAt(at));
  };
  pose.X_WT.p += ball_W(Standing()) - ball_W(pose);
  Update(pose);
  const Contacts contacts = Update(pose);
  EXPECT_LT(contacts[kHeelOfLeft], 0.2);
  EXPECT_GT(contacts[kToesOfLeft], 0.9);
}

TEST_F(FootContactsTest, SpeedIsTheSameAtEveryRate) {
  for (const double rate_hz : {10.0, 30.0, 100.0}) {
    feet_.Reset();
    PoseState pose = Standing();
    for (int i = 0; i < rate_hz; ++i) {
      Update(pose, 1 / rate_hz);
      pose.X_WT.p.y() += 300 / rate_hz;
    }
    Update(pose, 1 / rate_hz);
    EXPECT_NEAR(feet_.motions()[kHeelOfRight].speed_mm_s, 300, 1) << rate_hz;
  }
}

TEST_F(FootContactsTest, WithoutAFrameBeforeOrFeetNothingIsKnown) {
  EXPECT_TRUE(Update(Standing()).array().isNaN().all());
  EXPECT_TRUE(Update(Standing()).allFinite());
  feet_.Reset();
  EXPECT_TRUE(Update(Standing()).array().isNaN().all());
  EXPECT_TRUE(Update(Standing(), 0).array().isNaN().all()) << "two sets of the same time";
  const BodyModel paper(LoadBodyTable("mikic2003"), AverageSizes(1750));
  PoseState pose;
  pose.theta = JointAngles::Zero(paper.joint_count());
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(feet_.Update(paper, paper.PostureAt(pose), kFrame_s).array().isNaN().all());
}

}  // namespace
}  // namespace mocap
