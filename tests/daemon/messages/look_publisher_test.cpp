#include "daemon/messages/look_publisher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <set>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/body/body_sizes.h"
#include "drivers/clock.h"
#include "tests/support/heap_bytes.h"
#include "tests/support/idle_threads.h"
#include "tests/support/still_capture.h"

namespace mocap {
namespace {

constexpr std::int64_t kLookPatienceNs = 60'000'000'000;

/// Two cameras that see two people, and whoever listens to the looks.
class LookPublisherTest : public ::testing::Test {
 protected:
  LookPublisherTest() {
    for (const char* name : {"cam1", "cam2"}) {
      CameraCalibration& camera = cameras_.emplace_back();
      camera.name = name;
      camera.width_px = 64;
      camera.height_px = 48;
      OpenCvLens lens;
      lens.K << 50, 0, 32, 0, 50, 24, 0, 0, 1;
      camera.lens = lens;
      camera.X_CW.R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
      camera.X_CW.p = Vector3(0, 0, 5000);
    }
    lcm_.subscribe("MOCAP_LOOK", &LookPublisherTest::OnLook, this);
  }

  static look_request_t Request() {
    look_request_t request{};
    request.asker = "witness";
    request.rate_hz = 30;
    request.hold_s = 60;
    return request;
  }
  static CaptureResult Standing(const BodyModel& body) {
    CaptureResult result;
    result.state = CaptureState::kTracking;
    result.pose.theta = JointAngles::Zero(body.joint_count());
    return result;
  }
  static bool FillFrame(TappedFrame& frame) {
    std::ranges::fill(frame.image.pixels(), Bgr{200, 100, 50});
    frame.capture_ns = 5'000'000'123;
    return true;
  }
  /// A set, and a picture of each camera.
  void Offer(LookPublisher& publisher) {
    const VoxelGrid grid;
    publisher.OnSet({.result = anna_.result(), .body = body_, .people = people_, .grid = grid});
    for (FrameTap& tap : publisher.taps()) tap.Offer(FillFrame);
    lcm_.handleTimeout(1);
  }
  template <typename IsEnough>
  void OfferUntil(LookPublisher& publisher, IsEnough is_enough) {
    const std::int64_t end_ns = SteadyNs() + kLookPatienceNs;
    while (!is_enough() && SteadyNs() < end_ns) Offer(publisher);
    EXPECT_TRUE(is_enough());
  }
  void OnLook(const lcm::ReceiveBuffer*, const std::string&, const look_t* look) {
    looks_.push_back(*look);
  }

  std::vector<CameraCalibration> cameras_;
  const BodyModel body_{LoadBodyTable("full"), AverageSizes(1700)};
  testing::StillCapture anna_{body_, Standing(body_)}, ben_{body_, Standing(body_)};
  const std::vector<PersonView> people_ = {{.id = 3, .capture = &anna_},
                                           {.id = 4, .capture = &ben_}};
  lcm::LCM lcm_{"memq://"};
  LcmSender sender_{lcm_, LcmProvider::kMemory};
  std::vector<look_t> looks_;
};

TEST_F(LookPublisherTest, NothingIsTakenWhileNobodyAsks) {
  LookPublisher publisher(sender_, {}, cameras_, CaptureTimes::kRecorded);
  bool was_asked = false;
  publisher.taps().front().Offer([&](TappedFrame&) { return was_asked = true; });
  EXPECT_FALSE(was_asked);
}

TEST_F(LookPublisherTest, HasNoIdleThreadWhileNobodyHasAsked) {
  LookPublisher publisher(sender_, {}, cameras_, CaptureTimes::kRecorded);
  EXPECT_EQ(testing::CountIdleThreads(), 0);
}

TEST_F(LookPublisherTest, WhoAsksGetsEveryoneFromOneCameraAfterTheOther) {
  LookPublisher publisher(sender_, {}, cameras_, CaptureTimes::kRecorded);
  publisher.Ask(Request());
  OfferUntil(publisher, [this] { return looks_.size() >= 4; });
  std::set<std::string> whats;
  for (std::size_t i = 0; i < 4; ++i)
    whats.insert(looks_[i].camera + " " + std::to_string(looks_[i].person));
  EXPECT_EQ(whats, (std::set<std::string>{"cam1 3", "cam1 4", "cam2 3", "cam2 4"}));
  const look_t& look = looks_[0];
  EXPECT_EQ(look.camera, looks_[1].camera);
  EXPECT_EQ(look.capture_ns, 5'000'000'123);
  EXPECT_EQ(look.reduction, 1);
  EXPECT_EQ(look.width_px, look.side_px);
  EXPECT_NEAR(look.left_px + look.side_px / 2.0, 32, 6);
  EXPECT_GT(look.side_px, 15);
  EXPECT_LT(look.side_px, 40);
  EXPECT_NEAR(look.up[1], -1, 1e-6);
  EXPECT_EQ(look.encoding, std::int8_t{look_t::JPEG});
  EXPECT_EQ(look.num_bytes, static_cast<int>(look.picture.size()));
  EXPECT_EQ(look.picture[0], 0xff);
}

TEST_F(LookPublisherTest, ASmallRawPictureOfOnePersonCanBeAskedFor) {
  LookPublisher publisher(sender_, {}, cameras_, CaptureTimes::kRecorded);
  look_request_t request = Request();
  request.person = 4;
  request.side_px = 1;
  request.encoding = look_t::BGR;
  publisher.Ask(request);
  OfferUntil(publisher, [this] { return looks_.size() >= 2; });
  for (const look_t& look : looks_) {
    EXPECT_EQ(look.person, 4);
    EXPECT_LE(look.width_px, 32) << "no picture is asked for that shows nothing";
    ASSERT_EQ(look.picture.size(), 3u * static_cast<unsigned>(look.width_px * look.width_px));
    EXPECT_EQ(look.picture[0], 200);
    EXPECT_EQ(look.picture[2], 50);
  }
}

TEST_F(LookPublisherTest, WhoNoLongerAsksGetsNothing) {
  LookPublisher publisher(sender_, {}, cameras_, CaptureTimes::kRecorded);
  publisher.Ask(Request());
  OfferUntil(publisher, [this] { return !looks_.empty(); });
  look_request_t none = Request();
  none.rate_hz = 0;
  publisher.Ask(none);
  // What was begun may still come.
  for (int i = 0; i < 300; ++i) Offer(publisher);
  looks_.clear();
  for (int i = 0; i < 100; ++i) Offer(publisher);
  EXPECT_TRUE(looks_.empty());
}

TEST_F(LookPublisherTest, AskersWhoComeAndGoLeaveNoMemoryBehind) {
  const auto ask = [this](int times) {
    for (int i = 0; i < times; ++i) {
      LookPublisher publisher(sender_, {}, cameras_, CaptureTimes::kRecorded);
      publisher.Ask(Request());
      looks_.clear();
      OfferUntil(publisher, [this] { return !looks_.empty(); });
    }
    looks_.clear();
    looks_.shrink_to_fit();
  };
  ask(5);
  const std::int64_t before = HeapBytes();
  ask(20);
  EXPECT_LT(HeapBytes() - before, 20'000);
}

}  // namespace
}  // namespace mocap
