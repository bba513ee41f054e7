#include "daemon/messages/pose_publisher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <lcm/lcm-cpp.hpp>
#include <numeric>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "core/errors.h"
#include "tests/support/still_capture.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::StillCapture;

/// Keeps what arrives on a channel.
template <typename Message>
class Inbox {
 public:
  Inbox(lcm::LCM& lcm, const std::string& channel) {
    lcm.subscribe(channel, &Inbox::OnMessage, this);
  }
  std::vector<Message> messages;

 private:
  void OnMessage(const lcm::ReceiveBuffer*, const std::string&, const Message* message) {
    messages.push_back(*message);
  }
};

class PosePublisherTest : public ::testing::Test {
 protected:
  PosePublisherTest() : body_(LoadBodyTable("full"), AverageSizes(1700)) {
    result_.state = CaptureState::kTracking;
    result_.pose.theta = JointAngles::LinSpaced(body_.joint_count(), 0.1, 0.2);
    result_.pose.X_WT.p = Vector3(100, 200, 1300);
    result_.points_W = body_.PointsAt(body_.PostureAt(result_.pose));
    result_.point_std_mm.setConstant(4.5);
    result_.residual_mm = 12;
    result_.voxels = 3;
    grid_.Reset({-2, 4, 0}, {70, 2, 2}, 25);
    for (const auto& [i, j, k] : {std::array{3, 0, 0}, std::array{4, 0, 0}, std::array{69, 1, 1}}) {
      grid_.Set(i, j, k);
    }
  }

  TrackedSet Set() const {
    return {.frame = 7,
            .capture_ns = 1'700'000'000'123'456'789,
            .complete_ns = 1'700'000'000'133'000'000,
            .cameras = 0b101,
            .acquisition_frames = 3,
            .result = result_,
            .body = body_,
            .grid = grid_};
  }
  void Deliver() {
    while (lcm_.handleTimeout(0) > 0) {
    }
  }

  lcm::LCM lcm_{"memq://"};
  BodyModel body_;
  CaptureResult result_;
  VoxelGrid grid_;
};

TEST_F(PosePublisherTest, APoseArrivesWithAllThatTheContractNames) {
  Inbox<pose_t> inbox(lcm_, "MOCAP_POSE");
  PosePublisher publisher(lcm_, {}, 3);
  publisher.OnSet(Set());
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 1u);
  const pose_t& pose = inbox.messages[0];
  EXPECT_EQ(pose.utime, 1'700'000'000'123'456);
  EXPECT_EQ(pose.complete_utime, 1'700'000'000'133'000);
  EXPECT_GT(pose.publish_utime, pose.utime);
  EXPECT_EQ(pose.frame, 7);
  EXPECT_EQ(pose.state, int{pose_t::TRACKING});
  EXPECT_THAT(pose.torso_mm, ElementsAre(100, 200, 1300));
  EXPECT_EQ(pose.num_joints, body_.joint_count());
  EXPECT_EQ(pose.joint_rad[1], result_.pose.theta[1]);
  EXPECT_EQ(pose.theta_rad[2], body_.PaperStateOf(result_.pose).theta_rad[2]);
  EXPECT_EQ(pose.point_mm[22][2], result_.points_W(2, 22));
  EXPECT_EQ(pose.point_std_mm[22], 4.5);
  EXPECT_EQ(pose.residual_mm, 12);
  EXPECT_EQ(pose.voxels, 3);
  EXPECT_THAT(pose.camera_used, ElementsAre(1, 0, 1));
}

TEST_F(PosePublisherTest, WhileSearchingThereIsNoPoseButItsFrameIsTold) {
  result_.state = CaptureState::kSearching;
  result_.pose.theta.resize(0);
  Inbox<pose_t> inbox(lcm_, "MOCAP_POSE");
  PosePublisher publisher(lcm_, {}, 3);
  publisher.OnSet(Set());
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 1u);
  EXPECT_EQ(inbox.messages[0].state, int{pose_t::SEARCHING});
  EXPECT_EQ(inbox.messages[0].frame, 7);
  EXPECT_EQ(inbox.messages[0].point_mm[3][2], 0);
  EXPECT_EQ(inbox.messages[0].num_joints, body_.joint_count());
}

TEST_F(PosePublisherTest, EverybodyArrivesWithANumberAndABody) {
  Inbox<people_t> people(lcm_, "MOCAP_PEOPLE");
  Inbox<person_body_t> bodies(lcm_, "MOCAP_BODIES");
  Inbox<pose_t> poses(lcm_, "MOCAP_POSE");
  const StillCapture first(body_, result_);
  BodyModel small = body_;
  small.Resize(AverageSizes(1400));
  CaptureResult other = result_;
  other.state = CaptureState::kLost;
  other.pose.X_WT.p.x() = 900;
  const StillCapture second(small, other);
  const std::array<PersonView, 2> views = {PersonView{2, &first}, PersonView{5, &second, "anna"}};
  TrackedSet set = Set();
  set.people = views;
  PosePublisher publisher(lcm_, {}, 3);
  publisher.OnSet(set);
  Deliver();
  ASSERT_EQ(people.messages.size(), 1u);
  const people_t& message = people.messages[0];
  EXPECT_EQ(message.frame, 7);
  EXPECT_GT(message.publish_utime, message.utime);
  EXPECT_THAT(message.camera_used, ElementsAre(1, 0, 1));
  ASSERT_EQ(message.num_people, 2);
  EXPECT_EQ(message.people[0].id, 2);
  EXPECT_EQ(message.people[1].id, 5);
  EXPECT_EQ(message.people[0].name, "");
  EXPECT_EQ(message.people[1].name, "anna");
  EXPECT_EQ(message.people[1].state, int{pose_t::LOST});
  EXPECT_EQ(message.people[1].torso_mm[0], 900);
  // The first is the person of the pose.
  EXPECT_EQ(message.people[0].joint_rad, poses.messages.at(0).joint_rad);
  EXPECT_EQ(message.people[0].point_mm[22][2], poses.messages.at(0).point_mm[22][2]);
  ASSERT_EQ(bodies.messages.size(), 2u);
  EXPECT_EQ(bodies.messages[1].id, 5);
  EXPECT_EQ(bodies.messages[1].name, "anna");
  EXPECT_DOUBLE_EQ(bodies.messages[1].body.stature_mm, small.sizes().Stature());
}

TEST_F(PosePublisherTest, TheBodyOfANewcomerComesWithTheNewcomer) {
  Inbox<person_body_t> bodies(lcm_, "MOCAP_BODIES");
  const StillCapture capture(body_, result_);
  const std::array<PersonView, 2> views = {PersonView{1, &capture}, PersonView{2, &capture}};
  PosePublisher publisher(lcm_, {}, 3);
  TrackedSet set = Set();
  for (const std::size_t people : {1, 1, 2}) {
    set.people = std::span(views).first(people);
    publisher.OnSet(set);
  }
  Deliver();
  ASSERT_EQ(bodies.messages.size(), 2u);
  EXPECT_EQ(bodies.messages[0].id, 1);
  EXPECT_EQ(bodies.messages[1].id, 2);
}

TEST_F(PosePublisherTest, TheBodyComesAtOnceAndWhenItChanges) {
  Inbox<body_t> inbox(lcm_, "MOCAP_BODY");
  PosePublisher publisher(lcm_, {}, 3);
  publisher.OnSet(Set());
  result_.body_changed = true;
  publisher.OnSet(Set());
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 2u);
  const body_t& body = inbox.messages[1];
  EXPECT_EQ(body.model, "full");
  EXPECT_DOUBLE_EQ(body.stature_mm, body_.sizes().Stature());
  EXPECT_EQ(body.point_name[22], "foot_r");
  EXPECT_EQ(body.joint_name.size(), static_cast<std::size_t>(body_.joint_count()));
  EXPECT_EQ(body.joint_axis[2][0], body_.table().joints[2].axis_T.x());
  EXPECT_EQ(body.size_name[0], "torso");
  EXPECT_EQ(body.size_mm[0], body_.sizes().torso);
}

TEST_F(PosePublisherTest, NewSizesAreToldBeforeThePoseThatHasThem) {
  std::vector<std::string> channels;
  lcm_.subscribeFunction(
      "MOCAP_(POSE|BODY)",
      +[](const lcm::ReceiveBuffer*, const std::string& channel, std::vector<std::string>* heard) {
        heard->push_back(channel);
      },
      &channels);
  PosePublisher publisher(lcm_, {}, 3);
  for (const bool is_new : {false, true, false}) {
    result_.body_changed = is_new;
    publisher.OnSet(Set());
  }
  Deliver();
  EXPECT_THAT(channels,
              ElementsAre("MOCAP_BODY", "MOCAP_POSE", "MOCAP_BODY", "MOCAP_POSE", "MOCAP_POSE"));
}

TEST_F(PosePublisherTest, APoseCanBeDrawnAgainFromItsMessageAndTheBody) {
  Inbox<pose_t> poses(lcm_, "MOCAP_POSE");
  Inbox<body_t> bodies(lcm_, "MOCAP_BODY");
  PosePublisher publisher(lcm_, {}, 3);
  publisher.OnSet(Set());
  Deliver();
  ASSERT_EQ(poses.messages.size(), 1u);
  ASSERT_EQ(bodies.messages.size(), 1u);
  const pose_t& pose = poses.messages[0];
  const body_t& body = bodies.messages[0];
  // What a client does: turn each point about the axes that carry it, the last one first.
  for (int i = 0; i < kPointCount; ++i) {
    Vector3 p_T(body.point_reference_mm[i]);
    for (int joint = body.point_carrier[i]; joint >= 0; joint = body.joint_parent[joint]) {
      const Vector3 axis_T(body.joint_axis[joint].data());
      const Vector3 at_T(body.joint_place_mm[joint].data());
      p_T = RotationAbout(axis_T, at_T, pose.joint_rad[joint]) * p_T;
    }
    const Matrix3 R_WT = ExpRotation(pose.torso_angle_rad * Vector3(pose.torso_axis));
    const Vector3 p_W = R_WT * p_T + Vector3(pose.torso_mm);
    EXPECT_NEAR((p_W - Vector3(pose.point_mm[i])).norm(), 0, 1e-6) << body.point_name[i];
  }
}

TEST_F(PosePublisherTest, VoxelsComeOnlyWhenEnabledAndAsRuns) {
  Inbox<voxels_t> inbox(lcm_, "MOCAP_VOXELS");
  PosePublisher(lcm_, {}, 3).OnSet(Set());
  Deliver();
  EXPECT_TRUE(inbox.messages.empty());
  LcmConfig enabled;
  enabled.voxels_hz = 0.001;
  PosePublisher publisher(lcm_, enabled, 3);
  publisher.OnSet(Set());
  publisher.OnSet(Set());
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 1u) << "the rate is limited";
  const voxels_t& voxels = inbox.messages[0];
  EXPECT_THAT(voxels.run, ElementsAre(3, 2, 3 * 70 + 64, 1));
  EXPECT_EQ(std::accumulate(voxels.run.begin(), voxels.run.end(), 0), 70 * 2 * 2);
  EXPECT_EQ(voxels.label.size(), 3u);
  EXPECT_THAT(voxels.origin_mm, ElementsAre(-50, 100, 0));
  EXPECT_THAT(voxels.size, ElementsAre(70, 2, 2));
}

TEST_F(PosePublisherTest, ThePrefixStandsBeforeEachChannelsName) {
  Inbox<pose_t> poses(lcm_, "STAGE2_MOCAP_POSE");
  Inbox<status_t> statuses(lcm_, "STAGE2_MOCAP_STATUS");
  LcmConfig config;
  config.prefix = "STAGE2_";
  PosePublisher publisher(lcm_, config, 3);
  publisher.OnSet(Set());
  publisher.PublishStatus(ServiceReport{});
  Deliver();
  EXPECT_EQ(poses.messages.size(), 1u);
  EXPECT_EQ(statuses.messages.size(), 1u);
}

TEST_F(PosePublisherTest, WithTheStatusComesWhatEachCameraDoesNotKnow) {
  ServiceReport report;
  report.now.status.cameras.resize(2);
  report.now.status.cameras[0].name = "cam1";
  report.now.status.cameras[1].name = "cam2";
  report.now.status.cameras[1].health.unknown_share = 0.4;
  report.now.frames_per_second.resize(2);
  Inbox<contrast_t> inbox(lcm_, "MOCAP_CONTRAST");
  PosePublisher(lcm_, {}, 2).PublishStatus(report);
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 1u);
  EXPECT_EQ(inbox.messages[0].camera, (std::vector<std::string>{"cam1", "cam2"}));
  EXPECT_EQ(inbox.messages[0].unknown_share, (std::vector<double>{-1, 0.4}));
}

TEST_F(PosePublisherTest, WithTheStatusComesWhoSendsKeypoints) {
  ServiceReport report;
  report.keypoints.senders.emplace_back().name = "witness";
  Inbox<keypoint_senders_t> inbox(lcm_, "left.MOCAP_KEYPOINT_SENDERS");
  PosePublisher(lcm_, {.prefix = "left."}, 2).PublishStatus(report);
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 1u);
  EXPECT_EQ(inbox.messages[0].name, (std::vector<std::string>{"witness"}));
}

TEST_F(PosePublisherTest, TheStatusTellsCamerasAndStages) {
  PipelineStatus status;
  status.sets_complete = 90;
  status.sets_tracked = 60;
  CameraStatus camera;
  camera.name = "cam1";
  camera.state = CameraState::kLost;
  camera.frames = 60;
  camera.dropped = 2;
  status.cameras = {camera};
  StatusWindow window;
  window.Add(status, 0);
  status.sets_tracked += 60;
  status.cameras[0].frames += 58;
  StageRecorders recorders;
  recorders[Stage::kCarve].Record(20'000'000);
  status.stages = StageHistograms(recorders);
  Inbox<status_t> inbox(lcm_, "MOCAP_STATUS");
  ServiceReport report;
  report.now = window.Add(status, 2'000'000'000);
  PosePublisher(lcm_, {}, 1).PublishStatus(report);
  Deliver();
  ASSERT_EQ(inbox.messages.size(), 1u);
  const status_t& message = inbox.messages[0];
  EXPECT_EQ(message.sets_complete, 90);
  EXPECT_EQ(message.sets_per_second, 30);
  ASSERT_EQ(message.cameras.size(), 1u);
  EXPECT_EQ(message.cameras[0].name, "cam1");
  EXPECT_EQ(message.cameras[0].state, int{camera_status_t::LOST});
  EXPECT_EQ(message.cameras[0].frames_per_second, 29);
  EXPECT_EQ(message.cameras[0].dropped, 2);
  ASSERT_EQ(message.stages.size(), 7u);
  EXPECT_EQ(message.stages[1].name, "carve");
  EXPECT_EQ(message.stages[1].count, 1);
  EXPECT_NEAR(message.stages[1].p50_ms, 20, 0.6);
  EXPECT_EQ(message.stages[5].name, "latency");
  EXPECT_EQ(message.stages[6].name, "publish");
}

TEST(Pacer, KeepsItsRateAndForgetsALongPause) {
  Pacer pacer(10);
  EXPECT_TRUE(pacer.IsDue(1'000'000'000));
  EXPECT_FALSE(pacer.IsDue(1'099'000'000));
  EXPECT_TRUE(pacer.IsDue(1'130'000'000));
  EXPECT_TRUE(pacer.IsDue(1'200'000'000)) << "being late once does not move the rest";
  EXPECT_TRUE(pacer.IsDue(9'000'000'000));
  EXPECT_FALSE(pacer.IsDue(9'050'000'000)) << "what was missed is not made up for";
}

TEST(OpenLcm, ABadAddressIsASetupErrorOfOneLine) {
  try {
    OpenLcm("carrier-pigeon://coop");
    FAIL() << "opened";
  } catch (const SetupError& error) {
    EXPECT_THAT(error.what(), HasSubstr("carrier-pigeon://coop"));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace mocap
