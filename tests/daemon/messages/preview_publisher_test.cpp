#include "daemon/messages/preview_publisher.h"

#include <gtest/gtest.h>

#include <lcm/lcm-cpp.hpp>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "drivers/clock.h"
#include "tests/support/heap_bytes.h"
#include "tests/support/idle_threads.h"

namespace mocap {
namespace {

constexpr std::chrono::seconds kLong{1000};
constexpr std::int64_t kPatienceNs = 60'000'000'000;

/// A camera, a person, and whoever listens to the previews.
class PreviewPublisherTest : public ::testing::Test {
 protected:
  PreviewPublisherTest() {
    camera_.name = "cam1";
    camera_.width_px = 802;
    camera_.height_px = 4;
    lcm_.subscribe("MOCAP_PREVIEW", &PreviewPublisherTest::OnPreview, this);
    lcm_.subscribe("MOCAP_UNKNOWN", &PreviewPublisherTest::OnUnknown, this);
    lcm_.subscribe("MOCAP_VOXELS", &PreviewPublisherTest::OnVoxels, this);
  }

  /// Offers pictures until something was published.
  template <typename Offer>
  void OfferUntil(Offer offer, const int& received) {
    const std::int64_t end_ns = SteadyNs() + kPatienceNs;
    while (received == 0 && SteadyNs() < end_ns) {
      offer();
      lcm_.handleTimeout(1);
    }
  }
  static bool FillFrame(SeenFrame& frame) {
    frame.trimap = {Silhouette(802, 4), Silhouette(802, 4)};
    frame.trimap.person.Set(0, 0);
    for (int y = 0; y < 3; ++y) {
      for (int x = 3; x < 6; ++x) frame.trimap.unknown.Set(x, y);
    }
    frame.X_CW.p = Vector3(1, 2, 3);
    frame.capture_ns = 5'000'000;
    return true;
  }

  void OnPreview(const lcm::ReceiveBuffer*, const std::string&, const preview_t* preview) {
    preview_ = *preview;
    ++previews_;
  }
  void OnUnknown(const lcm::ReceiveBuffer*, const std::string&, const unknown_t* unknown) {
    unknown_ = *unknown;
  }
  void OnVoxels(const lcm::ReceiveBuffer*, const std::string&, const voxels_t* voxels) {
    voxels_ = *voxels;
    ++voxel_messages_;
  }

  CameraCalibration camera_;
  lcm::LCM lcm_{"memq://"};
  LcmSender sender_{lcm_, LcmProvider::kMemory};
  int previews_ = 0, voxel_messages_ = 0;
  preview_t preview_;
  unknown_t unknown_;
  voxels_t voxels_;
};

TEST_F(PreviewPublisherTest, NothingIsTakenWhileNobodyLooks) {
  PreviewPublisher publisher(sender_, {}, {camera_}, CaptureTimes::kRecorded);
  bool was_asked = false;
  publisher.taps().front().Offer([&](SeenFrame&) { return was_asked = true; });
  EXPECT_FALSE(was_asked);
}

// Idle threads end late on busy processors, and a start may be ended at once.
TEST_F(PreviewPublisherTest, HasNoIdleThreadWhileNobodyHasLooked) {
  PreviewPublisher publisher(sender_, {}, {camera_}, CaptureTimes::kRecorded);
  EXPECT_EQ(testing::CountIdleThreads(), 0);
  publisher.Look(kLong);
  EXPECT_EQ(testing::CountIdleThreads(), 1);
}

TEST_F(PreviewPublisherTest, ViewersWhoComeAndGoLeaveNoMemoryBehind) {
  const auto look = [this](int times) {
    for (int i = 0; i < times; ++i) {
      PreviewPublisher publisher(sender_, {}, {camera_}, CaptureTimes::kRecorded);
      publisher.Look(kLong);
      previews_ = 0;
      OfferUntil([&] { publisher.taps().front().Offer(FillFrame); }, previews_);
    }
  };
  look(10);
  const std::int64_t before = HeapBytes();
  look(40);
  EXPECT_LT(HeapBytes() - before, 20'000);
}

TEST_F(PreviewPublisherTest, WhoLooksGetsPicturesWithTheirTrimaps) {
  PreviewPublisher publisher(sender_, {}, {camera_}, CaptureTimes::kRecorded);
  publisher.Look(kLong);
  OfferUntil([&] { publisher.taps().front().Offer(FillFrame); }, previews_);
  ASSERT_GT(previews_, 0);
  EXPECT_EQ(preview_.camera, "cam1");
  EXPECT_EQ(preview_.utime, 5000);
  EXPECT_EQ(preview_.width_px, 802);
  EXPECT_EQ(preview_.reduction, 3);
  EXPECT_EQ(preview_.translation_mm[2], 3);
  EXPECT_EQ(preview_.num_bytes, static_cast<int>(preview_.jpeg.size()));
  EXPECT_EQ(preview_.jpeg[0], 0xff);
  EXPECT_EQ(preview_.run.size(), 1u) << "a single pixel is less than half of its square";
  EXPECT_EQ(unknown_.camera, preview_.camera);
  EXPECT_EQ(unknown_.utime, preview_.utime) << "it comes before its picture";
  EXPECT_EQ(unknown_.run, (std::vector<std::int32_t>{1, 1, 265}));
}

TEST_F(PreviewPublisherTest, WhoLooksGetsVoxelsWithTheirParts) {
  PreviewPublisher publisher(sender_, {}, {camera_}, CaptureTimes::kRecorded);
  const BodyModel body(LoadBodyTable("full"), AverageSizes(1700));
  CaptureResult result;
  result.state = CaptureState::kTracking;
  result.pose.theta = JointAngles::Zero(body.joint_count());
  VoxelGrid grid;
  grid.Reset({0, 0, 0}, {2, 1, 1}, 25);
  grid.Set(1, 0, 0);
  publisher.Look(kLong);
  OfferUntil([&] { publisher.OnSet({.frame = 9, .result = result, .body = body, .grid = grid}); },
             voxel_messages_);
  ASSERT_GT(voxel_messages_, 0);
  EXPECT_EQ(voxels_.frame, 9);
  EXPECT_EQ(voxels_.run, (std::vector<std::int32_t>{1, 1}));
  EXPECT_EQ(voxels_.num_labels, 1);
}

}  // namespace
}  // namespace mocap
