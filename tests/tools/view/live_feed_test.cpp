#include "tools/view/live_feed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <map>
#include <mocap/service_t.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "daemon/messages/messages.h"
#include "drivers/take/calibration_file.h"
#include "tests/tools/view/number_at.h"

namespace mocap {
namespace {

/// A count of 0 in a message.
const std::string kNothing(4, '\0');

CameraCalibration Camera() {
  CameraCalibration camera;
  camera.name = "cam1";
  camera.width_px = 40;
  camera.height_px = 30;
  OpenCvLens lens;
  lens.K << 30, 0, 20, 0, 30, 15, 0, 0, 1;
  camera.lens = lens;
  camera.X_CW.p = Vector3(0, 0, 3000);
  return camera;
}

/// Of a pose without capsules and without a rival.
constexpr std::size_t kPoseBytes = 392;

/// A feed that hears what the test publishes, and what it put on the board.
class LiveFeedTest : public ::testing::Test {
 protected:
  template <typename Message>
  void Publish(const std::string& channel, const Message& message) {
    lcm_.publish(channel, &message);
    while (lcm_.handleTimeout(0) > 0) {
    }
  }
  nlohmann::json Json(std::size_t slot) { return nlohmann::json::parse(board_.at(slot)); }
  static studio_t Studio() {
    studio_t studio{};
    studio.name = "small";
    studio.calibration = CalibrationText("calibration.toml", std::vector{Camera()});
    return studio;
  }
  static preview_t Preview() {
    preview_t preview{};
    preview.camera = "cam1";
    preview.utime = 5000;
    for (int i = 0; i < 3; ++i) preview.rotation[i][i] = 1;
    preview.width_px = 40;
    preview.height_px = 30;
    preview.reduction = 2;
    preview.jpeg = {0xff, 0xd8};
    preview.num_bytes = 2;
    preview.run = {20 * 5, 20 * 5};
    preview.num_runs = 2;
    return preview;
  }
  pose_t Pose() {
    CaptureResult result;
    result.state = CaptureState::kTracking;
    result.pose.theta = JointAngles::Zero(body_.joint_count());
    result.pose.X_WT.p = Vector3(0, 0, 1000);
    result.points_W = body_.PointsAt(body_.PostureAt(result.pose));
    result.point_std_mm.setConstant(1);
    const VoxelGrid grid;
    pose_t pose{};
    FillPose({.frame = 3, .capture_ns = 5'000'000, .result = result, .body = body_, .grid = grid},
             1, pose);
    return pose;
  }

  /// Tells of people with these numbers, who stand 900 mm apart.
  people_t People(const std::vector<int>& ids) {
    const pose_t pose = Pose();
    people_t set{};
    set.utime = pose.utime;
    set.publish_utime = 7000;
    set.num_people = static_cast<std::int32_t>(ids.size());
    for (const int id : ids) {
      person_t& person = set.people.emplace_back();
      person.id = id;
      person.state = pose.state;
      person.num_joints = pose.num_joints;
      person.joint_rad = pose.joint_rad;
      std::ranges::copy(pose.torso_mm, person.torso_mm);
      person.torso_mm[0] += 900 * static_cast<double>(set.people.size() - 1);
      std::memcpy(person.point_mm, pose.point_mm, sizeof(person.point_mm));
    }
    return set;
  }
  person_body_t BodyOf(int id) {
    person_body_t body{};
    body.id = id;
    FillBody(body_, 0, body.body);
    return body;
  }
  /// What lies at an offset of the poses on the board.
  template <typename T>
  T PosesAt(std::size_t offset) {
    T value;
    std::memcpy(&value, board_.at(LiveFeed::kPoses).data() + offset, sizeof(T));
    return value;
  }
  /// The colour of each person who is told of, by number.
  std::map<int, int> Colors() {
    std::map<int, int> colors;
    const nlohmann::json told = Json(LiveFeed::kPeople);
    for (const auto& person : told["people"]) {
      colors[person["id"]] = person["color"];
    }
    return colors;
  }

  lcm::LCM lcm_{"memq://"};
  std::map<std::size_t, std::string> board_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  LiveFeed feed_{lcm_, "left.", "memq://",
                 [this](std::size_t slot, LiveMessage message) { board_[slot] = *message.bytes; }};
};

TEST_F(LiveFeedTest, AStudioIsDrawnFromItsCalibration) {
  Publish("left.MOCAP_STUDIO", Studio());
  const nlohmann::json camera = Json(LiveFeed::kStudio)["cameras"][0];
  EXPECT_EQ(camera["name"], "cam1");
  EXPECT_NEAR(camera["position_mm"][2], -3000.0, 1e-9);
  EXPECT_NEAR(camera["corners_mm"][2][0], 1000.0 * 19 / 30, 1e-6);
  EXPECT_NEAR(camera["corners_mm"][2][2], -2000.0, 1e-9);
}

TEST_F(LiveFeedTest, OtherDaemonsAreNotHeard) {
  Publish("left_MOCAP_STUDIO", Studio());
  Publish("MOCAP_STUDIO", Studio());
  EXPECT_FALSE(board_.contains(LiveFeed::kStudio));
}

TEST_F(LiveFeedTest, APoseHasTheCapsulesOfTheTracker) {
  body_t body{};
  FillBody(body_, 0, body);
  Publish("left.MOCAP_BODY", body);
  EXPECT_EQ(Json(LiveFeed::kBody)["capsule_parts"].size(), body_.shape().size());
  Publish("left.MOCAP_POSE", Pose());
  EXPECT_EQ(board_.at(LiveFeed::kPoses).size(), kPoseBytes + 32 * body_.shape().size());
}

TEST_F(LiveFeedTest, ABodyOfAnotherModelIsDrawnFromItsPoints) {
  body_t body{};
  FillBody(body_, 0, body);
  body.model = "/etc/passwd";
  Publish("left.MOCAP_BODY", body);
  Publish("left.MOCAP_POSE", Pose());
  EXPECT_EQ(board_.at(LiveFeed::kPoses).size(), kPoseBytes + 32 * 13);
}

TEST_F(LiveFeedTest, SizesThatNobodyHasDrawNothing) {
  body_t body{};
  FillBody(body_, 0, body);
  body.size_mm[0] = -1;
  Publish("left.MOCAP_BODY", body);
  Publish("left.MOCAP_POSE", Pose());
  EXPECT_EQ(board_.at(LiveFeed::kPoses).size(), kPoseBytes);
}

TEST_F(LiveFeedTest, APoseThatIsNoNumberIsNotPassedOn) {
  pose_t pose = Pose();
  pose.point_mm[4][1] = std::numeric_limits<double>::quiet_NaN();
  Publish("left.MOCAP_POSE", pose);
  EXPECT_FALSE(board_.contains(LiveFeed::kPoses));
}

TEST_F(LiveFeedTest, EverybodyOfASetGoesOutAtOnceInColoursOfTheirOwn) {
  Publish("left.MOCAP_PEOPLE", People({4, 9}));
  Publish("left.MOCAP_BODIES", BodyOf(9));
  Publish("left.MOCAP_PEOPLE", People({4, 9}));
  const std::size_t second = kPoseBytes;
  ASSERT_EQ(board_.at(LiveFeed::kPoses).size(), second + kPoseBytes + 32 * body_.shape().size());
  EXPECT_EQ(PosesAt<std::uint8_t>(1), 0);
  EXPECT_EQ(PosesAt<std::uint32_t>(316), 4u);
  EXPECT_EQ(PosesAt<std::uint8_t>(second + 1), 1);
  EXPECT_EQ(PosesAt<std::uint32_t>(board_.at(LiveFeed::kPoses).size() - 76), 9u);
  EXPECT_NEAR(PosesAt<float>(second + 316), 900, 500) << "the flesh is where the person is";
}

TEST_F(LiveFeedTest, APersonInDoubtComesWithTheRival) {
  const people_t set = People({4, 9});
  person_details_t details{};
  details.utime = set.utime;
  details.person = 9;
  details.probability = 0.6;
  details.rival_probability = 0.25;
  details.rival_point_mm.assign(kPointCount, {1, 2, 3});
  details.num_rival_points = kPointCount;
  Publish("left.MOCAP_DETAILS", details);
  Publish("left.MOCAP_PEOPLE", set);
  ASSERT_EQ(board_.at(LiveFeed::kPoses).size(), 2 * kPoseBytes + 276);
  EXPECT_TRUE(std::isnan(PosesAt<float>(320))) << "nothing was told of the first";
  EXPECT_EQ(PosesAt<float>(kPoseBytes + 320), 0.6f);
  EXPECT_EQ(PosesAt<float>(kPoseBytes + 324), 0.25f);
  EXPECT_EQ(PosesAt<float>(kPoseBytes + 328 + 272), 3);
  details.rival_point_mm.resize(3);
  details.num_rival_points = 3;
  Publish("left.MOCAP_DETAILS", details);
  Publish("left.MOCAP_PEOPLE", set);
  EXPECT_EQ(board_.at(LiveFeed::kPoses).size(), 2 * kPoseBytes) << "three points are no body";
  people_t later = set;
  later.utime += 40'000;
  Publish("left.MOCAP_PEOPLE", later);
  EXPECT_TRUE(std::isnan(PosesAt<float>(kPoseBytes + 320))) << "they are of another set";
}

TEST_F(LiveFeedTest, WhoeverStaysKeepsTheColour) {
  Publish("left.MOCAP_PEOPLE", People({1, 2}));
  Publish("left.MOCAP_PEOPLE", People({2}));
  EXPECT_EQ(Colors(), (std::map<int, int>{{2, 1}}));
  Publish("left.MOCAP_PEOPLE", People({2, 3, 4}));
  EXPECT_EQ(Colors(), (std::map<int, int>{{2, 1}, {3, 0}, {4, 2}}));
}

TEST_F(LiveFeedTest, WhetherSomebodyHasComeIsKnownOfThoseWhoCameLater) {
  Publish("left.MOCAP_PEOPLE", People({1}));
  Publish("left.MOCAP_PEOPLE", People({1, 2}));
  const nlohmann::json people = Json(LiveFeed::kPeople)["people"];
  EXPECT_EQ(people[0]["has_come"], false);
  EXPECT_EQ(people[1]["has_come"], true);
  EXPECT_EQ(people[1]["since_ms"], 7.0);
}

TEST_F(LiveFeedTest, ADaemonThatWasStartedAnewHasOtherPeople) {
  Publish("left.MOCAP_PEOPLE", People({}));
  Publish("left.MOCAP_PEOPLE", People({1}));
  EXPECT_EQ(Json(LiveFeed::kPeople)["people"][0]["has_come"], true);
  people_t later = People({1});
  later.publish_utime += 60'000'000;
  Publish("left.MOCAP_PEOPLE", later);
  EXPECT_EQ(Json(LiveFeed::kPeople)["people"][0]["has_come"], false);
  EXPECT_EQ(Json(LiveFeed::kPeople)["people"][0]["since_ms"], 60007.0);
}

TEST_F(LiveFeedTest, NobodyIsDrawnTwice) {
  Publish("left.MOCAP_PEOPLE", People({1, 2}));
  const std::string people = board_.at(LiveFeed::kPoses);
  Publish("left.MOCAP_POSE", Pose());
  EXPECT_EQ(board_.at(LiveFeed::kPoses), people);
}

TEST_F(LiveFeedTest, WhoHasNoNumberYetIsDrawnFromThePose) {
  Publish("left.MOCAP_PEOPLE", People({1}));
  Publish("left.MOCAP_POSE", Pose());
  Publish("left.MOCAP_PEOPLE", People({}));
  EXPECT_EQ(PosesAt<std::uint32_t>(316), 0u);
  EXPECT_TRUE(Colors().empty());
}

TEST_F(LiveFeedTest, ACrowdThatNoDaemonFollowsIsCutShort) {
  std::vector<int> ids(5000);
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<int>(i);
  Publish("left.MOCAP_PEOPLE", People(ids));
  EXPECT_EQ(board_.at(LiveFeed::kPoses).size(), 8 * kPoseBytes);
  EXPECT_EQ(Colors().size(), 8u);
}

TEST_F(LiveFeedTest, APictureHasTheBodyOfEachInHisColour) {
  const auto first_line = [&] {
    const std::string& bytes = board_.at(LiveFeed::kPictures);
    std::uint32_t silhouette;
    std::memcpy(&silhouette, bytes.data() + 16, sizeof(silhouette));
    float kind;
    std::memcpy(&kind, bytes.data() + 32 + 4 * silhouette + 4, sizeof(kind));
    return static_cast<int>(kind);
  };
  Publish("left.MOCAP_STUDIO", Studio());
  Publish("left.MOCAP_PEOPLE", People({7, 8}));
  Publish("left.MOCAP_BODIES", BodyOf(8));
  Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_EQ(first_line() / 4, 2) << "the second colour";
  Publish("left.MOCAP_PEOPLE", People({8}));
  Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_EQ(first_line() / 4, 0) << "those of the sides";
}

TEST_F(LiveFeedTest, APictureOfAKnownCameraIsPassedOnWithItsLines) {
  Publish("left.MOCAP_POSE", Pose());
  Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_FALSE(board_.contains(LiveFeed::kPictures)) << "no studio is known";
  Publish("left.MOCAP_STUDIO", Studio());
  Publish("left.MOCAP_PREVIEW", Preview());
  ASSERT_TRUE(board_.contains(LiveFeed::kPictures));
  EXPECT_NE(board_.at(LiveFeed::kPictures).substr(16, 4), kNothing) << "the silhouette's line";
}

TEST_F(LiveFeedTest, APictureHasTheUnknownPixelsOfItsMomentOnly) {
  const auto trimap_floats = [this] {
    return testing::NumberAt<std::uint32_t>(board_.at(LiveFeed::kPictures), 16);
  };
  unknown_t unknown{};
  unknown.camera = "cam1";
  unknown.utime = 5000;
  unknown.run = {20 * 10, 20 * 5};
  unknown.num_runs = 2;
  preview_t next = Preview();
  next.utime = 6000;
  Publish("left.MOCAP_STUDIO", Studio());
  Publish("left.MOCAP_UNKNOWN", unknown);
  Publish("left.MOCAP_PREVIEW", Preview());
  unknown.utime = 5500;
  Publish("left.MOCAP_UNKNOWN", unknown);
  Publish("left.MOCAP_PREVIEW", next);
  constexpr std::uint32_t kRectangle = 2 + 2 * 4;
  EXPECT_EQ(trimap_floats(), 2 * kRectangle) << "person and unknown pixels";
  Publish("left.MOCAP_PREVIEW", next);
  EXPECT_EQ(trimap_floats(), kRectangle) << "the person alone";
}

TEST_F(LiveFeedTest, APictureTellsHowMuchOfThePeopleIsUnknown) {
  const auto share = [this] {
    return testing::NumberAt<float>(board_.at(LiveFeed::kPictures), 28);
  };
  Publish("left.MOCAP_STUDIO", Studio());
  for (int i = 0; i < 2; ++i) Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_EQ(share(), -1);
  contrast_t contrast{};
  contrast.num_cameras = 2;
  contrast.camera = {"cam0", "cam1"};
  contrast.unknown_share = {-1, 0.5};
  Publish("left.MOCAP_CONTRAST", contrast);
  Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_EQ(share(), 0.5F);
}

TEST_F(LiveFeedTest, APictureWaitsForThePoseOfItsMoment) {
  body_t body{};
  FillBody(body_, 0, body);
  Publish("left.MOCAP_BODY", body);
  Publish("left.MOCAP_STUDIO", Studio());
  Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_FALSE(board_.contains(LiveFeed::kPictures));
  Publish("left.MOCAP_POSE", Pose());
  ASSERT_TRUE(board_.contains(LiveFeed::kPictures));
  EXPECT_NE(board_.at(LiveFeed::kPictures).substr(20, 4), kNothing) << "the body's lines";
}

TEST_F(LiveFeedTest, WithoutPosesAPictureWaitsForTheNextOne) {
  Publish("left.MOCAP_STUDIO", Studio());
  Publish("left.MOCAP_PREVIEW", Preview());
  Publish("left.MOCAP_PREVIEW", Preview());
  EXPECT_TRUE(board_.contains(LiveFeed::kPictures));
}

TEST_F(LiveFeedTest, ForgedPicturesAreLeftOut) {
  Publish("left.MOCAP_STUDIO", Studio());
  preview_t preview = Preview();
  preview.reduction = 0;
  Publish("left.MOCAP_PREVIEW", preview);
  preview = Preview();
  preview.width_px = 2'000'000'000;
  Publish("left.MOCAP_PREVIEW", preview);
  preview = Preview();
  preview.camera = "cam2";
  Publish("left.MOCAP_PREVIEW", preview);
  EXPECT_FALSE(board_.contains(LiveFeed::kPictures));
}

TEST_F(LiveFeedTest, WhyThereAreNoPicturesIsTold) {
  feed_.NoteControl("mocapd is not running here");
  EXPECT_EQ(Json(LiveFeed::kNotice)["pictures"], "mocapd is not running here");
  EXPECT_EQ(Json(LiveFeed::kNotice)["control"], "mocapd is not running here");
}

TEST_F(LiveFeedTest, WordsThatAreNoUtf8DoNoHarm) {
  service_t service{};
  service.studio = "\xff\xfe<script>";
  service.num_complaints = 1;
  service.complaint = {"\xc3"};
  Publish("left.MOCAP_SERVICE", service);
  EXPECT_EQ(Json(LiveFeed::kStatus)["complaints"].size(), 1u);
}

}  // namespace
}  // namespace mocap
