#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <map>
#include <mocap/keypoints_t.hpp>
#include <string>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "daemon/messages/messages.h"
#include "drivers/take/calibration_file.h"
#include "tests/tools/view/number_at.h"
#include "tools/view/live_feed.h"

namespace mocap {
namespace {

/// A feed that knows two cameras and what it put on the board.
class LiveKeypointsTest : public ::testing::Test {
 protected:
  LiveKeypointsTest() {
    studio_t studio{};
    studio.name = "small";
    studio.calibration =
        CalibrationText("calibration.toml", std::vector{Camera("cam1"), Camera("cam2")});
    Publish("MOCAP_STUDIO", studio);
  }
  static CameraCalibration Camera(const std::string& name) {
    CameraCalibration camera;
    camera.name = name;
    camera.width_px = 40;
    camera.height_px = 30;
    OpenCvLens lens;
    lens.K << 30, 0, 20, 0, 30, 15, 0, 0, 1;
    camera.lens = lens;
    return camera;
  }
  template <typename Message>
  void Publish(const std::string& channel, const Message& message) {
    lcm_.publish(channel, &message);
    while (lcm_.handleTimeout(0) > 0) {
    }
  }
  void PublishPose() {
    const VoxelGrid grid;
    pose_t pose{};
    const CaptureResult searching;
    FillPose({.frame = 3, .capture_ns = kPoseNs, .result = searching, .body = body_, .grid = grid},
             1, pose);
    Publish("MOCAP_POSE", pose);
  }
  static keypoints_t Keypoints(std::int64_t capture_ns = kPoseNs) {
    keypoints_t message{};
    message.version = keypoints_t::VERSION;
    message.sender = "example";
    message.camera = "cam2";
    message.capture_ns = capture_ns;
    message.points = {{"nose", 10, 20, 0.5}, {"left_shoulder", 12, 24, 0.75}};
    message.num_points = 2;
    return message;
  }
  bool AreShown() const { return board_.contains(LiveFeed::kKeypoints + 1); }

  static constexpr std::int64_t kPoseNs = 5'000'000'000;
  lcm::LCM lcm_{"memq://"};
  std::map<std::size_t, std::string> board_;
  BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  LiveFeed feed_{lcm_, "", "memq://",
                 [this](std::size_t slot, LiveMessage message) { board_[slot] = *message.bytes; }};
};

TEST_F(LiveKeypointsTest, KeypointsArePassedOnByCamera) {
  PublishPose();
  Publish("MOCAP_KEYPOINTS", Keypoints());
  ASSERT_TRUE(AreShown());
  const std::string& bytes = board_.at(LiveFeed::kKeypoints + 1);
  ASSERT_EQ(bytes.size(), 48u);
  EXPECT_EQ(bytes.substr(0, 2), "\4\1");
  EXPECT_EQ(testing::NumberAt<double>(bytes, 8), 5000);
  EXPECT_EQ(testing::NumberAt<float>(bytes, 32), 9) << "COCO's name is understood";
  EXPECT_FALSE(board_.contains(LiveFeed::kKeypoints));
}

TEST_F(LiveKeypointsTest, EverybodyInAPictureIsShown) {
  PublishPose();
  keypoints_t second = Keypoints();
  second.person = 1;
  Publish("MOCAP_KEYPOINTS", Keypoints());
  Publish("MOCAP_KEYPOINTS", second);
  EXPECT_EQ(board_.at(LiveFeed::kKeypoints + 1).size(), 2 * 48u);
}

TEST_F(LiveKeypointsTest, ThoseOfOtherMomentsAreNotShown) {
  Publish("MOCAP_KEYPOINTS", Keypoints());
  EXPECT_FALSE(AreShown()) << "no moment is shown yet";
  PublishPose();
  for (const std::int64_t capture_ns :
       {std::int64_t{0}, kPoseNs - 1'000'000'001, kPoseNs + 1'000'000'001,
        std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
    Publish("MOCAP_KEYPOINTS", Keypoints(capture_ns));
    EXPECT_FALSE(AreShown()) << capture_ns;
  }
}

TEST_F(LiveKeypointsTest, ForgedOnesAreLeftOut) {
  PublishPose();
  keypoints_t forged = Keypoints();
  forged.camera = "cam9";
  Publish("MOCAP_KEYPOINTS", forged);
  forged = Keypoints();
  forged.version = 9;
  Publish("MOCAP_KEYPOINTS", forged);
  forged = Keypoints();
  for (keypoint_t& point : forged.points) point.x_px = std::numeric_limits<double>::quiet_NaN();
  Publish("MOCAP_KEYPOINTS", forged);
  EXPECT_FALSE(AreShown());
}

}  // namespace
}  // namespace mocap
