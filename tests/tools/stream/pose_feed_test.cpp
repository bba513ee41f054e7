#include "tools/stream/pose_feed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/posed_people.h"
#include "tools/stream/pose_json.h"

namespace mocap {
namespace {

using Json = nlohmann::json;
using testing::BodyMessage;
using ::testing::ElementsAre;
using testing::PersonMessage;
using testing::PoseMessage;
using testing::RandomPose;

class PoseFeedTest : public ::testing::Test {
 protected:
  void Listen(const PoseFeedOptions& options) {
    feed_.emplace(lcm_, options, [this](const StreamedPose& pose) {
      lines_.push_back(Json::parse(PoseJson(pose)));
    });
  }
  template <typename Message>
  void Publish(const std::string& channel, const Message& message) {
    lcm_.publish(channel, &message);
    while (lcm_.handleTimeout(0) > 0) {
    }
  }
  pose_t Pose(std::int64_t frame) {
    return PoseMessage(body_, RandomPose(body_, static_cast<unsigned>(frame)), frame);
  }
  people_t People(const std::vector<person_t>& people, std::int64_t frame) {
    people_t set{};
    set.utime = Pose(frame).utime;
    set.frame = frame;
    set.people = people;
    set.num_people = static_cast<std::int32_t>(people.size());
    return set;
  }
  void PublishBody(int id) {
    person_body_t message{};
    message.id = id;
    message.body = BodyMessage(body_);
    Publish("MOCAP_BODIES", message);
  }

  lcm::LCM lcm_{"memq://"};
  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  std::optional<PoseFeed> feed_;
  std::vector<Json> lines_;
};

TEST_F(PoseFeedTest, ATrackedPoseIsALineWithPointsAndAnglesByName) {
  Listen({});
  Publish("MOCAP_BODY", BodyMessage(body_));
  const pose_t pose = Pose(3);
  Publish("MOCAP_POSE", pose);
  ASSERT_EQ(lines_.size(), 1u);
  const Json& line = lines_[0];
  EXPECT_EQ(line["utime"], pose.utime);
  EXPECT_EQ(line["frame"], 3);
  EXPECT_EQ(line["state"], "tracking");
  EXPECT_FALSE(line.contains("person"));
  EXPECT_EQ(line["points_mm"].size(), std::size_t{kPointCount});
  const int hand = static_cast<int>(Point::kFingertipsL);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(line["points_mm"]["fingertips_l"][axis], pose.point_mm[hand][axis], 6e-4);
  }
  ASSERT_EQ(line["joints_rad"].size(), static_cast<std::size_t>(body_.joint_count()));
  for (int i = 0; i < body_.joint_count(); ++i) {
    const std::string& name = body_.table().joints[static_cast<std::size_t>(i)].name;
    EXPECT_NEAR(line["joints_rad"][name], pose.joint_rad[static_cast<std::size_t>(i)], 6e-7);
  }
  const Matrix3 R = ExpRotation(Vector3(pose.torso_axis) * pose.torso_angle_rad);
  for (int i = 0; i < 9; ++i)
    EXPECT_NEAR(line["torso_rotation"][i / 3][i % 3], R(i / 3, i % 3), 1e-6);
}

TEST_F(PoseFeedTest, TellsHowSureAPoseIsIfItsDetailsDo) {
  Listen({.everybody = true});
  const pose_t pose = Pose(1);
  const auto publish_details = [&](int person, double probability) {
    person_details_t details{};
    details.utime = pose.utime;
    details.person = person;
    details.probability = probability;
    Publish("MOCAP_DETAILS", details);
  };
  for (const int id : {3, 4, 5}) PublishBody(id);
  publish_details(3, 0.61234567);
  publish_details(4, std::nan(""));
  std::vector<person_t> people;
  for (const int id : {3, 4, 5}) people.push_back(PersonMessage(id, "", pose));
  Publish("MOCAP_PEOPLE", People(people, 1));
  Publish("MOCAP_PEOPLE", People(people, 2));
  ASSERT_EQ(lines_.size(), 6u);
  EXPECT_EQ(lines_[0]["probability"], 0.6123);
  for (int i = 1; i < 6; ++i) EXPECT_FALSE(lines_[i].contains("probability")) << lines_[i];
}

TEST_F(PoseFeedTest, WhoIsNotTrackedHasNoNumbers) {
  Listen({});
  Publish("MOCAP_BODY", BodyMessage(body_));
  pose_t pose = Pose(1);
  for (const int state : {pose_t::SEARCHING, pose_t::ACQUIRING, pose_t::LOST}) {
    pose.state = static_cast<std::int8_t>(state);
    Publish("MOCAP_POSE", pose);
  }
  ASSERT_EQ(lines_.size(), 3u);
  for (const Json& line : lines_) EXPECT_EQ(line.size(), 3u) << line;
  EXPECT_EQ(lines_[1]["state"], "acquiring");
}

TEST_F(PoseFeedTest, ATrackedPoseIsPassedOverUntilItsBodyIsHeard) {
  Listen({});
  Publish("MOCAP_POSE", Pose(1));
  body_t other = BodyMessage(BodyModel(LoadBodyTable("mikic2003"), AverageSizes(1700)));
  Publish("MOCAP_BODY", other);
  Publish("MOCAP_POSE", Pose(2));
  EXPECT_TRUE(lines_.empty());
  Publish("MOCAP_BODY", BodyMessage(body_));
  Publish("MOCAP_POSE", Pose(3));
  EXPECT_EQ(lines_.size(), 1u);
}

TEST_F(PoseFeedTest, ARateIsOfTheTimesOfCapture) {
  PoseFeedOptions options;
  options.most_hz = 10;
  Listen(options);
  Publish("MOCAP_BODY", BodyMessage(body_));
  pose_t pose = Pose(1);
  for (int i = 0; i < 100; ++i, pose.utime += 20'000) Publish("MOCAP_POSE", pose);
  // Two seconds, and what the limit saves at the start.
  EXPECT_NEAR(lines_.size(), 20, 2);
}

TEST_F(PoseFeedTest, WhatIsNoNumberIsPassedOver) {
  Listen({});
  Publish("MOCAP_BODY", BodyMessage(body_));
  pose_t pose = Pose(1);
  pose.joint_rad[4] = std::numeric_limits<double>::quiet_NaN();
  Publish("MOCAP_POSE", pose);
  pose = Pose(1);
  pose.point_mm[7][1] = std::numeric_limits<double>::infinity();
  Publish("MOCAP_POSE", pose);
  pose = Pose(1);
  pose.utime = std::numeric_limits<std::int64_t>::max();
  Publish("MOCAP_POSE", pose);
  pose = Pose(1);
  body_t body = BodyMessage(body_);
  pose.num_joints = body.num_joints = 1000;
  for (auto* angles : {&pose.joint_rad, &body.joint_min_rad, &body.joint_max_rad})
    angles->resize(1000);
  body.joint_name.resize(1000);
  body.joint_parent.resize(1000);
  body.joint_axis.resize(1000, std::vector<double>(3));
  body.joint_place_mm.resize(1000, std::vector<double>(3));
  Publish("MOCAP_BODY", body);
  Publish("MOCAP_POSE", pose);
  EXPECT_TRUE(lines_.empty());
}

TEST_F(PoseFeedTest, EverybodyHasALineWithNumberAndName) {
  Listen({.everybody = true});
  const person_t anna = PersonMessage(2, "anna", Pose(5)), other = PersonMessage(7, "", Pose(6));
  Publish("MOCAP_PEOPLE", People({anna, other}, 0));
  EXPECT_TRUE(lines_.empty());
  for (const int id : {2, 7}) PublishBody(id);
  Publish("MOCAP_PEOPLE", People({anna, other}, 1));
  Publish("MOCAP_PEOPLE", People({}, 2));
  ASSERT_EQ(lines_.size(), 2u);
  EXPECT_EQ(lines_[0]["person"], 2);
  EXPECT_EQ(lines_[0]["name"], "anna");
  EXPECT_EQ(lines_[1]["person"], 7);
  EXPECT_EQ(lines_[1]["frame"], 1);
  EXPECT_TRUE(lines_[1].contains("points_mm"));
}

TEST_F(PoseFeedTest, OnePersonIsChosenByNumberAndMissedWhenGone) {
  Listen({.person = 7});
  PublishBody(7);
  const person_t anna = PersonMessage(2, "anna", Pose(5)), other = PersonMessage(7, "", Pose(6));
  PublishBody(7);
  Publish("MOCAP_PEOPLE", People({anna, other}, 1));
  Publish("MOCAP_PEOPLE", People({anna}, 2));
  ASSERT_EQ(lines_.size(), 2u);
  EXPECT_EQ(lines_[0]["person"], 7);
  EXPECT_EQ(lines_[0]["state"], "tracking");
  EXPECT_EQ(lines_[1]["person"], 7);
  EXPECT_EQ(lines_[1]["state"], "searching");
  EXPECT_FALSE(lines_[1].contains("points_mm"));
}

TEST_F(PoseFeedTest, WhoIsThereIsKnownWhileThePersonIsNot) {
  Listen({.person = 99});
  EXPECT_EQ(feed_->LastSeen(), "");
  const std::int64_t begin_ns = feed_->present_ns();
  Publish("MOCAP_PEOPLE",
          People({PersonMessage(2, "anna", Pose(5)), PersonMessage(7, "", Pose(6))}, 1));
  Publish("MOCAP_PEOPLE", People({}, 2));
  EXPECT_EQ(feed_->LastSeen(), "last seen: person 2 (anna), person 7");
  EXPECT_EQ(feed_->present_ns(), begin_ns);
  EXPECT_GT(feed_->heard_ns(), begin_ns);
  Publish("MOCAP_PEOPLE", People({PersonMessage(99, "", Pose(7))}, 3));
  EXPECT_GT(feed_->present_ns(), begin_ns);
}

TEST_F(PoseFeedTest, OnlyThePrefixThatIsMeantIsHeard) {
  Listen({.prefix = "left."});
  Publish("left.MOCAP_BODY", BodyMessage(body_));
  for (const char* channel : {"MOCAP_POSE", "leftXMOCAP_POSE", "left.MOCAP_POSE"}) {
    Publish(channel, Pose(4));
  }
  EXPECT_EQ(lines_.size(), 1u);
}

TEST(RateLimit, PassesAllThatComesAtItsRateThoughEarlyAndLateByTurns) {
  RateLimit limit(50);
  int passed = 0;
  for (std::int64_t i = 0; i < 1000; ++i) {
    const std::int64_t jitter_ns = i % 2 == 0 ? 4'000'000 : -4'000'000;
    passed += limit.Passes(1'000'000'000'000 + i * 20'000'000 + jitter_ns);
  }
  EXPECT_EQ(passed, 1000);
}

TEST(RateLimit, PassesThatManyOfMoreWhateverTheirRate) {
  for (const int hz : {60, 100, 140, 1000}) {
    RateLimit limit(50);
    int passed = 0;
    for (std::int64_t i = 0; i < 10 * hz; ++i)
      passed += limit.Passes(1'000'000'000'000 + i * 1'000'000'000LL / hz);
    EXPECT_NEAR(passed, 500, 2) << hz;
  }
}

TEST(RateLimit, ASilenceSavesNoMoreThanTwo) {
  RateLimit limit(1);
  for (const std::int64_t at_s : {1, 2}) EXPECT_TRUE(limit.Passes(at_s * 1'000'000'000));
  int passed = 0;
  for (std::int64_t i = 0; i < 100; ++i) passed += limit.Passes(3'600'000'000'000 + i * 1'000'000);
  EXPECT_EQ(passed, 2);
}

}  // namespace
}  // namespace mocap
