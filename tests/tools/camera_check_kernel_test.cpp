// What is said of Linux's own test cameras when they fail. tools/check_vm runs these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drivers/v4l2/v4l2_driver.h"
#include "tests/support/vivid.h"
#include "tools/camera_check.h"

namespace mocap::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kSeconds = 4, kFps = 10;
constexpr int kFramesBefore = 5;

/// A camera to which something happens once some frames have come, and with each one after.
class FailingDriver : public V4l2Driver {
 public:
  FailingDriver(const CameraRequest& request, std::function<void()> fail)
      : V4l2Driver(request, {.format = "GREY", .gain = 100}), fail_(std::move(fail)) {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override {
    const GrabStatus status = V4l2Driver::Grab(frame, timeout);
    if (status == GrabStatus::kFrame && ++frames_ >= kFramesBefore) fail_();
    return status;
  }

 private:
  const std::function<void()> fail_;
  int frames_ = 0;
};

class Vivid : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = WhyNoVivid(); !reason.empty()) GTEST_SKIP() << reason;
    nodes_ = VividNodes();
  }

  /// What is said of the first of two cameras; the other one is to be well.
  std::vector<std::string> TroublesWhen(std::function<void()> fail) {
    std::vector<LiveCamera> cameras(2);
    const auto nothing = [] {};
    for (int i = 0; i < 2; ++i) {
      cameras[i].name = "cam" + std::to_string(i + 1);
      cameras[i].request = {nodes_[i].bus, 320, 180, kFps};
      cameras[i].driver = std::make_unique<FailingDriver>(
          cameras[i].request, i == 0 ? fail : std::function<void()>(nothing));
    }
    const std::vector<CameraRun> runs = WatchCameras(cameras, kSeconds);
    EXPECT_THAT(TroublesOf(runs[1], {}), IsEmpty());
    if (!runs[0].error.empty()) return {runs[0].error};
    return TroublesOf(runs[0], {});
  }
  void Set(const std::string& control, int value) { SetControl(nodes_[0], control, value); }

  std::vector<V4l2Node> nodes_;
};

TEST_F(Vivid, NothingIsSaidOfCamerasThatWork) {
  EXPECT_THAT(TroublesWhen([] {}), IsEmpty());
}

TEST_F(Vivid, DroppedBuffersAreNamed) {
  const auto troubles = TroublesWhen([this] { Set("Percentage of Dropped Buffers", 40); });
  Set("Percentage of Dropped Buffers", 0);
  EXPECT_THAT(troubles, ElementsAre(HasSubstr("frames were lost")));
}

TEST_F(Vivid, ErrorBuffersAreNamed) {
  EXPECT_THAT(TroublesWhen([this] { Set("Inject V4L2_BUF_FLAG_ERROR", 1); }),
              ElementsAre(HasSubstr("frames arrived damaged")));
}

TEST_F(Vivid, CameraThatDoesNotBeginIsNamed) {
  for (const char* call : {"VIDIOC_REQBUFS", "VIDIOC_STREAMON"}) {
    Set(std::string("Inject ") + call + " Error", 1);
    EXPECT_THAT(TroublesWhen([] {}), ElementsAre(HasSubstr(nodes_[0].path))) << call;
  }
}

TEST_F(Vivid, CameraThatGoesAwayIsNamed) {
  for (const char* fault : {"Inject Fatal Streaming Error", "Disconnect"}) {
    bool done = false;
    EXPECT_THAT(TroublesWhen([this, fault, &done] {
                  if (!std::exchange(done, true)) Set(fault, 1);
                }),
                ElementsAre(HasSubstr("was lost once")))
        << fault;
  }
}

}  // namespace
}  // namespace mocap::testing
