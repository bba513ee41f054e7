#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "tests/support/exported_bvh.h"
#include "tests/support/moving_body.h"
#include "tools/results/export_axes.h"

namespace mocap {
namespace {

using testing::Append;
using testing::Cm;
using testing::ExpectHandsAndFeet;
using testing::ExpectPlaces;
using testing::GrownBody;
using testing::JointsAt;
using testing::kBvhDegree;
using testing::MakeOld;
using testing::PlacesAt;
using testing::ReadBvh;
using testing::ResultOf;
using testing::RightArmRaised;
using testing::Standing;
using testing::Swinging;
using testing::SwingingResult;
using testing::TrackedRow;
using testing::Turn;
using testing::WrittenBvh;

/// The segment that turns with each joint.
const std::map<std::string, Segment>& Segments() {
  static const std::map<std::string, Segment> segments = {{"Hips", Segment::kPelvis},
                                                          {"Spine", Segment::kTorso},
                                                          {"Neck", Segment::kHead},
                                                          {"Head", Segment::kHead},
                                                          {"LeftShoulder", Segment::kShoulderL},
                                                          {"RightShoulder", Segment::kShoulderR},
                                                          {"LeftArm", Segment::kUpperArmL},
                                                          {"RightArm", Segment::kUpperArmR},
                                                          {"LeftForeArm", Segment::kLowerArmL},
                                                          {"RightForeArm", Segment::kLowerArmR},
                                                          {"LeftHand", Segment::kHandL},
                                                          {"RightHand", Segment::kHandR},
                                                          {"LeftUpLeg", Segment::kThighL},
                                                          {"RightUpLeg", Segment::kThighR},
                                                          {"LeftLeg", Segment::kCalfL},
                                                          {"RightLeg", Segment::kCalfR},
                                                          {"LeftFoot", Segment::kFootL},
                                                          {"RightFoot", Segment::kFootR},
                                                          {"LeftToe", Segment::kToesL},
                                                          {"RightToe", Segment::kToesR}};
  return segments;
}

/// A segment's axes: x to the person's left, y up, z forward of who stands in a T-pose.
Matrix3 AxesOf(const BodyModel& body, const PoseState& pose, Segment segment) {
  const Posture posture = body.PostureAt(pose);
  const int carrier = body.table().carrier[static_cast<int>(segment)];
  const Matrix3 R_W = carrier < 0 ? posture.X_WT.R : posture.X_W[carrier].R;
  return YUpFromWorld() * R_W * YUpFromWorld().transpose();
}

TEST(BvhWriter, RaisesTheRightArmOnTheRightOfAPersonWhoFacesWorldX) {
  const BodyModel body = GrownBody();
  const Result result = ResultOf(body, RightArmRaised(body));
  const auto places = PlacesAt(WrittenBvh(result), 0);
  ExpectPlaces(places, result.poses[0]);
  EXPECT_GT(places.at("RightHand_end").y(), places.at("Head_end").y() + 20);
  EXPECT_LT(places.at("LeftHand_end").y(), places.at("Hips").y());
  EXPECT_LT(places.at("RightHand_end").x(), 40) << "the middle of the body is at 50 cm";
  EXPECT_GT(places.at("LeftHand_end").x(), 60);
  EXPECT_LT(places.at("LeftFoot").z(), places.at("LeftLeg").z() - 20) << "the bent knee";
  EXPECT_LT(places.at("LeftToe").y(), places.at("LeftFoot").y() - 10) << "its foot points down";
  EXPECT_GT(places.at("RightToe").z(), places.at("RightFoot").z() + 10) << "the other one, forward";
}

TEST(BvhWriter, FeetAndHeadTurnToTheirSide) {
  const BodyModel body = GrownBody();
  PoseState pose = Standing(body);
  Turn(body, "hip_l_z", 40, pose);
  Turn(body, "ankle_r_y", 30, pose);
  Turn(body, "neck_x", 20, pose);
  const auto places = PlacesAt(WrittenBvh(ResultOf(body, pose)), 0);
  EXPECT_GT(places.at("LeftToe_end").x(), places.at("LeftFoot").x() + 8) << "turned out";
  // The ankle's axis is oblique.
  EXPECT_NEAR(places.at("RightToe_end").x(), places.at("RightFoot").x(), 3);
  EXPECT_LT(places.at("RightToe_end").y(), places.at("LeftToe_end").y() - 8) << "toes down";
  EXPECT_LT(places.at("Head_end").x(), places.at("Neck").x() - 5) << "to the right shoulder";
}

TEST(BvhWriter, JointsTurnAsTheSegmentsDo) {
  for (const char* table : {"full", "mikic2003"}) {
    const BodyModel body = GrownBody(table);
    const ReadBvh bvh = WrittenBvh(SwingingResult(60, body));
    for (int i = 0; i < 60; ++i) {
      const auto joints = JointsAt(bvh, i);
      for (const auto& [name, segment] : Segments()) {
        const Matrix3 wanted = AxesOf(body, Swinging(body, 0.04 * i), segment);
        EXPECT_TRUE(joints.at(name).linear().isApprox(wanted, 1e-5)) << name << ' ' << i;
      }
    }
  }
}

TEST(BvhWriter, ALimbThatTurnsAboutItselfTurnsItsJoint) {
  const BodyModel body = GrownBody();
  for (const auto& [turn, joint] :
       {std::pair("shoulder_l_y", "LeftArm"), std::pair("hip_r_z", "RightUpLeg")}) {
    double last = 0;
    Result result{RecordOf(body), {}};
    for (int degrees = 0; degrees <= 40; ++degrees) {
      PoseState pose = Standing(body);
      Turn(body, turn, degrees, pose);
      Append(body, pose, result);
    }
    const ReadBvh bvh = WrittenBvh(result);
    for (std::size_t i = 1; i < bvh.frames.size(); ++i) {
      const Matrix3 R = JointsAt(bvh, i).at(joint).linear();
      const double turned = Eigen::AngleAxisd(R).angle() / kBvhDegree;
      EXPECT_NEAR(turned - last, 1, 1e-3) << joint << ' ' << i;
      last = turned;
    }
  }
}

TEST(BvhWriter, BonesOfOldResultsPointAtTheirPoints) {
  for (const char* table : {"full", "mikic2003"}) {
    Result result = SwingingResult(60, GrownBody(table));
    MakeOld(result);
    const ReadBvh bvh = WrittenBvh(result);
    for (std::size_t i = 0; i < result.poses.size(); ++i) {
      const auto places = PlacesAt(bvh, i);
      ExpectPlaces(places, result.poses[i]);
      const Eigen::Vector3d sole =
          Cm(result.poses[i].points_W.col(static_cast<int>(Point::kFootL)));
      const Eigen::Vector3d shin = (places.at("LeftLeg") - sole).normalized();
      EXPECT_NEAR(shin.dot(places.at("LeftToe_end") - sole), 0, 0.01) << "fixed to the shin";
    }
  }
}

TEST(BvhWriter, FeetOfEarlierVersionsAreFixedToTheShinAndHandsTurn) {
  const BodyModel body = GrownBody();
  Result result = SwingingResult(60, body);
  testing::MakeOfEarlierFull(result);
  const ReadBvh bvh = WrittenBvh(result);
  for (int i = 0; i < 60; ++i) {
    const auto joints = JointsAt(bvh, i);
    for (const std::string side : {"Left", "Right"}) {
      const Matrix3 R_shin = joints.at(side + "Leg").linear();
      EXPECT_TRUE(joints.at(side + "Foot").linear().isApprox(R_shin, 1e-5)) << side << ' ' << i;
      EXPECT_TRUE(joints.at(side + "Toe").linear().isApprox(R_shin, 1e-5)) << side << ' ' << i;
    }
    for (const auto& [name, segment] : Segments()) {
      if (name.ends_with("Foot") || name.ends_with("Toe") || segment == Segment::kHead) continue;
      const Matrix3 wanted = AxesOf(body, Swinging(body, 0.04 * i), segment);
      EXPECT_TRUE(joints.at(name).linear().isApprox(wanted, 1e-5)) << name << ' ' << i;
    }
  }
}

TEST(BvhWriter, AFrameThatLostItsDetailsKeepsItsFeet) {
  const BodyModel body = GrownBody();
  Result result = SwingingResult(3, body);
  testing::LoseDetails(result.poses[1]);
  const ReadBvh bvh = WrittenBvh(result);
  for (const auto& [name, segment] : Segments()) {
    const Matrix3 wanted = AxesOf(body, Swinging(body, 0.04), segment);
    EXPECT_TRUE(JointsAt(bvh, 1).at(name).linear().isApprox(wanted, 1e-5)) << name;
  }
}

TEST(BvhWriter, RestsWithTheArmsOutAndFacesZ) {
  const BodyModel body = GrownBody();
  ReadBvh bvh = WrittenBvh(ResultOf(body, RightArmRaised(body)));
  std::ranges::fill(bvh.frames[0], 0);
  PoseRow rest = TrackedRow(body, Standing(body));
  rest.points_W.colwise() -= (rest.points_W.col(static_cast<int>(Point::kHipL)) +
                              rest.points_W.col(static_cast<int>(Point::kHipR))) /
                             2;
  ExpectPlaces(PlacesAt(bvh, 0), rest);
}

TEST(BvhWriter, KeepsEveryJointInPlaceThoughWaistCollarBonesAndWristsTurn) {
  for (const char* table : {"full", "mikic2003"}) {
    const BodyModel body = GrownBody(table);
    const Result result = SwingingResult(60, body);
    const ReadBvh bvh = WrittenBvh(result);
    for (std::size_t i = 0; i < result.poses.size(); ++i) {
      const auto places = PlacesAt(bvh, i);
      ExpectPlaces(places, result.poses[i]);
      ExpectHandsAndFeet(places, body, Swinging(body, 0.04 * static_cast<double>(i)));
    }
  }
}

TEST(BvhWriter, HasNoJumpsInItsCurves) {
  const ReadBvh bvh = WrittenBvh(SwingingResult(60));
  for (std::size_t i = 1; i < bvh.frames.size(); ++i) {
    for (std::size_t c = 3; c < bvh.frames[i].size(); ++c) {
      EXPECT_LT(std::abs(bvh.frames[i][c] - bvh.frames[i - 1][c]), 170) << "channel " << c;
    }
  }
}

TEST(BvhWriter, GivesTheFrameTime) {
  EXPECT_NEAR(WrittenBvh(SwingingResult(5)).frame_time, 0.04, 1e-6);
}

}  // namespace
}  // namespace mocap
