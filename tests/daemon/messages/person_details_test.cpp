// person_details_t, as the daemon sends it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <lcm/lcm-cpp.hpp>
#include <span>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "daemon/messages/pose_publisher.h"
#include "tests/support/still_capture.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using testing::StillCapture;

class DetailsTest : public ::testing::Test {
 protected:
  DetailsTest() : body_(LoadBodyTable("full"), AverageSizes(1700)) {
    lcm_.subscribe("MOCAP_DETAILS", &DetailsTest::OnDetails, this);
    result_.state = CaptureState::kTracking;
    result_.pose.theta = JointAngles::LinSpaced(body_.joint_count(), 0.1, 0.2);
    result_.points_W = body_.PointsAt(body_.PostureAt(result_.pose));
    result_.point_std_mm.setConstant(4.5);
    result_.further_W = body_.FurtherPointsAt(body_.PostureAt(result_.pose));
    result_.further_std_mm.setConstant(6.5);
    result_.joint_std_rad = JointAngles::Constant(body_.joint_count(), 0.05);
    result_.contacts << 0.9, 0.8, 0.2, 0.1;
    result_.probability = 0.75;
    result_.rival = RivalPose{0.2, result_.points_W.array() + 1};
  }

  void Publish(std::span<const PersonView> people, const LcmConfig& config = {}) {
    const TrackedSet set{.frame = 7,
                         .capture_ns = 1'700'000'000'123'456'789,
                         .cameras = 0b101,
                         .result = result_,
                         .body = body_,
                         .people = people,
                         .grid = grid_};
    PosePublisher(lcm_, config, 3).OnSet(set);
    while (lcm_.handleTimeout(0) > 0) {
    }
  }

  lcm::LCM lcm_{"memq://"};
  BodyModel body_;
  CaptureResult result_;
  VoxelGrid grid_;
  std::vector<person_details_t> heard_;

 private:
  void OnDetails(const lcm::ReceiveBuffer*, const std::string&, const person_details_t* message) {
    heard_.push_back(*message);
  }
};

TEST_F(DetailsTest, TellHowSureThePoseOfEachPersonIs) {
  const StillCapture first(body_, result_);
  CaptureResult other = result_;
  other.probability.reset();
  other.rival.reset();
  other.contacts = kUnknownContacts;
  const StillCapture second(body_, other);
  Publish(std::array{PersonView{2, &first}, PersonView{5, &second}});
  ASSERT_EQ(heard_.size(), 2u);
  const person_details_t& details = heard_[0];
  EXPECT_EQ(details.utime, 1'700'000'000'123'456);
  EXPECT_EQ(details.frame, 7);
  EXPECT_EQ(details.person, 2);
  EXPECT_EQ(details.place, 0);
  EXPECT_EQ(details.state, int{pose_t::TRACKING});
  EXPECT_EQ(details.probability, 0.75);
  EXPECT_EQ(details.num_contacts, kContactCount);
  EXPECT_EQ(details.rival_probability, 0.2);
  ASSERT_EQ(details.num_rival_points, kPointCount);
  EXPECT_EQ(details.rival_point_mm[22][2], result_.points_W(2, 22) + 1);
  EXPECT_EQ(heard_[1].person, 5);
  EXPECT_EQ(heard_[1].place, 1);
  EXPECT_TRUE(std::isnan(heard_[1].probability)) << "this tracker cannot tell";
  EXPECT_EQ(heard_[1].num_contacts, 0);
  EXPECT_EQ(heard_[1].rival_probability, 0);
  EXPECT_TRUE(heard_[1].rival_point_mm.empty());
}

TEST_F(DetailsTest, HavePointsAndJointsByTheirNames) {
  const StillCapture capture(body_, result_);
  Publish(std::array{PersonView{1, &capture}});
  ASSERT_EQ(heard_.size(), 1u);
  const person_details_t& details = heard_[0];
  ASSERT_EQ(details.num_points, kPlaceCount);
  for (int i = 0; i < kPointCount; ++i) {
    EXPECT_EQ(details.point_name[i], kPointNames[i]);
    EXPECT_EQ(details.point_std_mm[i], 4.5);
  }
  EXPECT_EQ(details.point_mm[22][2], result_.points_W(2, 22));
  for (int i = 0; i < kFurtherPointCount; ++i) {
    EXPECT_EQ(details.point_name[kPointCount + i], kFurtherPointNames[i]);
    EXPECT_EQ(details.point_mm[kPointCount + i][1], result_.further_W(1, i));
    EXPECT_EQ(details.point_std_mm[kPointCount + i], result_.further_std_mm[i]);
  }
  EXPECT_THAT(details.contact_name, ElementsAreArray(kContactNames));
  EXPECT_THAT(details.contact, ElementsAreArray(result_.contacts));
  ASSERT_EQ(details.num_joints, body_.joint_count());
  EXPECT_EQ(details.joint_name[2], body_.table().joints[2].name);
  EXPECT_THAT(details.joint_rad, ElementsAreArray(result_.pose.theta));
  EXPECT_THAT(details.joint_std_rad, ElementsAreArray(result_.joint_std_rad));
}

TEST_F(DetailsTest, HoldNoNumbersWhileSearching) {
  result_.state = CaptureState::kSearching;
  const StillCapture capture(body_, result_);
  Publish(std::array{PersonView{1, &capture}});
  ASSERT_EQ(heard_.size(), 1u);
  const person_details_t& details = heard_[0];
  EXPECT_TRUE(std::isnan(details.probability));
  EXPECT_EQ(details.rival_probability, 0);
  EXPECT_EQ(details.num_points + details.num_joints + details.num_rival_points, 0);
}

TEST_F(DetailsTest, ComeBeforeThePosesOfTheirSet) {
  std::vector<std::string> channels;
  lcm_.subscribeFunction(
      "left.MOCAP_(POSE|PEOPLE|DETAILS)",
      +[](const lcm::ReceiveBuffer*, const std::string& channel, std::vector<std::string>* heard) {
        heard->push_back(channel);
      },
      &channels);
  const StillCapture capture(body_, result_);
  LcmConfig config;
  config.prefix = "left.";
  Publish(std::array{PersonView{1, &capture}, PersonView{2, &capture}}, config);
  EXPECT_THAT(channels, ElementsAre("left.MOCAP_DETAILS", "left.MOCAP_DETAILS", "left.MOCAP_POSE",
                                    "left.MOCAP_PEOPLE"));
}

}  // namespace
}  // namespace mocap
