#include "drivers/pan_tilt.h"

#include <gtest/gtest.h>

#include <numbers>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "drivers/angle_track.h"
#include "drivers/pan_tilt_camera.h"
#include "drivers/v4l2/v4l2_pan_tilt.h"
#include "drivers/v4l2/v4l2_time.h"
#include "tests/support/fake_machine.h"

namespace mocap::testing {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr int kDegree = 3600;  // Seconds of arc.

TEST(AngleTrack, InterpolatesBetweenReadingsAndHoldsBeyondThem) {
  AngleTrack track;
  EXPECT_EQ(track.At(5), PanTiltAngles{});
  track.Add(100, {0.1, -0.2});
  track.Add(200, {0.3, -0.6});
  track.Add(150, {9, 9});  // Out of order.
  EXPECT_EQ(track.At(0), (PanTiltAngles{0.1, -0.2}));
  EXPECT_DOUBLE_EQ(track.At(125).pan_rad, 0.15);
  EXPECT_DOUBLE_EQ(track.At(125).tilt_rad, -0.3);
  EXPECT_EQ(track.At(999), (PanTiltAngles{0.3, -0.6}));
}

TEST(AngleTrack, ForgetsTheOldest) {
  AngleTrack track;
  for (int i = 0; i < 1000; ++i) track.Add(i, {1.0 * i, 0});
  EXPECT_EQ(track.At(0).pan_rad, 1000 - static_cast<int>(AngleTrack::kReadings));
}

/// A webcam with a head.
class V4l2Head : public ::testing::Test {
 protected:
  V4l2Head() : camera_(machine_.Plug(0, "A1")) {
    camera_.controls = {{V4L2_CID_PAN_ABSOLUTE, {-100 * kDegree, 100 * kDegree, 0}},
                        {V4L2_CID_TILT_ABSOLUTE, {-30 * kDegree, 30 * kDegree, 0}}};
  }

  V4l2PanTilt Head(std::chrono::nanoseconds delay = {}) {
    return {"A1", delay, machine_.kernel, machine_.tree};
  }

  FakeMachine machine_;
  FakeCamera& camera_;
};

TEST_F(V4l2Head, TurnsAndTellsWhereItPoints) {
  V4l2PanTilt head = Head();
  head.Start();
  EXPECT_NEAR(head.limits().most.pan_rad, 100 * kDegree_rad, 1e-9);
  EXPECT_NEAR(head.limits().least.tilt_rad, -30 * kDegree_rad, 1e-9);
  EXPECT_TRUE(head.TurnTo({20 * kDegree_rad, -10 * kDegree_rad}));
  EXPECT_EQ(camera_.controls[V4L2_CID_PAN_ABSOLUTE].value, 20 * kDegree);
  EXPECT_EQ(camera_.controls[V4L2_CID_TILT_ABSOLUTE].value, -10 * kDegree);
  head.Update();
  const PanTiltAngles now = head.At(TimelineNs());
  EXPECT_NEAR(now.pan_rad, 20 * kDegree_rad, 1e-9);
  EXPECT_NEAR(now.tilt_rad, -10 * kDegree_rad, 1e-9);
}

TEST_F(V4l2Head, RefusesDirectionsThatItDoesNotReach) {
  V4l2PanTilt head = Head();
  head.Start();
  EXPECT_FALSE(head.TurnTo({101 * kDegree_rad, 0}));
  EXPECT_FALSE(head.TurnTo({0, -31 * kDegree_rad}));
  EXPECT_EQ(camera_.controls[V4L2_CID_PAN_ABSOLUTE].value, 0);
}

TEST_F(V4l2Head, AngleBetweenReadingsIsInterpolatedAndDelayed) {
  constexpr std::chrono::seconds kDelay{5};
  V4l2PanTilt head = Head(kDelay);
  head.Start();
  const std::int64_t before_ns = TimelineNs();
  camera_.controls[V4L2_CID_PAN_ABSOLUTE].value = 40 * kDegree;
  head.Update();
  const std::int64_t after_ns = TimelineNs();
  // A reading tells where the head pointed five seconds ago.
  EXPECT_NEAR(head.At(after_ns - std::chrono::nanoseconds(kDelay).count()).pan_rad,
              40 * kDegree_rad, 1e-9);
  EXPECT_LT(head.At(before_ns - std::chrono::nanoseconds(kDelay).count()).pan_rad,
            40 * kDegree_rad);
}

TEST_F(V4l2Head, CameraWithoutOneIsASetupError) {
  camera_.controls.erase(V4L2_CID_TILT_ABSOLUTE);
  V4l2PanTilt head = Head();
  EXPECT_THROW(head.Start(), SetupError);
  EXPECT_EQ(camera_.handles, 0);
}

TEST_F(V4l2Head, CameraOnItGivesEachFrameItsAngles) {
  auto made = std::make_unique<V4l2PanTilt>("A1", std::chrono::nanoseconds{}, machine_.kernel,
                                            machine_.tree);
  PanTiltCamera camera(std::make_unique<V4l2Driver>(CameraRequest{"A1", 64, 48, 30}, V4l2Settings{},
                                                    machine_.kernel, machine_.tree),
                       std::move(made));
  camera.Start();
  EXPECT_TRUE(camera.head().TurnTo({7 * kDegree_rad, 0}));
  Frame frame;
  constexpr std::chrono::milliseconds kTimeout{100};
  for (int i = 0; i < 3; ++i) ASSERT_EQ(camera.Grab(frame, kTimeout), GrabStatus::kFrame);
  EXPECT_NEAR(frame.angles.pan_rad, 7 * kDegree_rad, 1e-9);
  camera.Stop();
  EXPECT_EQ(camera_.handles, 0);
}

}  // namespace
}  // namespace mocap::testing
