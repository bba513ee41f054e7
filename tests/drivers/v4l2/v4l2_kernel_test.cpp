// The driver on Linux's own test devices. tools/check_vm runs these in a machine that has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "drivers/clock.h"
#include "drivers/v4l2/v4l2_driver.h"
#include "tests/drivers/driver_suite.h"
#include "tests/support/vivid.h"

namespace mocap::testing {
namespace {

using ::testing::HasSubstr;

constexpr std::chrono::milliseconds kKernelTimeout{500};
constexpr int kPatience = 100;

V4l2Driver VividDriver(const V4l2Node& node, const std::string& format = "GREY", double fps = 25) {
  return {{node.bus, 320, 180, fps}, {.format = format}};
}

struct VividFactory {
  static constexpr bool kEnds = false;
  std::string WhySkip() { return WhyNoVivid(); }
  std::unique_ptr<CameraDriver> Make() {
    const V4l2Node node = VividNodes().at(made_++);
    return std::make_unique<V4l2Driver>(CameraRequest{node.bus, 320, 180, 25},
                                        V4l2Settings{.format = "YUYV"});
  }
  std::size_t made_ = 0;
};
INSTANTIATE_TYPED_TEST_SUITE_P(Vivid, CameraDriverSuite, VividFactory);

class Vivid : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = WhyNoVivid(); !reason.empty()) GTEST_SKIP() << reason;
    nodes_ = VividNodes();
  }

  /// Grabs until a status comes; counts what else came.
  bool GrabUntil(V4l2Driver& driver, GrabStatus wanted) {
    for (int i = 0; i < kPatience; ++i) {
      if (driver.Grab(frame_, kKernelTimeout) == wanted) return true;
    }
    return false;
  }

  static bool Starts(V4l2Driver& driver) {
    try {
      driver.Start();
      return true;
    } catch (const SetupError&) {
      return false;
    }
  }

  std::vector<V4l2Node> nodes_;
  Frame frame_;
};

TEST_F(Vivid, EveryFormatGivesThePictureThatTheOthersGive) {
  // The middles of the bars that vivid shows: white, yellow, cyan, green, magenta, red, blue,
  // black.
  for (const char* format :
       {"YUYV", "UYVY", "NV12", "RGB3", "BGR3", "RGGB", "GRBG", "GBRG", "BA81"}) {
    V4l2Driver driver = VividDriver(nodes_[0], format);
    driver.Start();
    ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame)) << format;
    // Below the text that vivid writes.
    const int y = frame_.image.height() - 10, bar = frame_.image.width() / 8;
    const Bgr yellow = frame_.image(bar + bar / 2, y), blue = frame_.image(6 * bar + bar / 2, y);
    EXPECT_GT(yellow.r, 140) << format;
    EXPECT_GT(yellow.g, 140) << format;
    EXPECT_LT(yellow.b, 100) << format;
    EXPECT_GT(blue.b, 140) << format;
    EXPECT_LT(blue.r, 100) << format;
    EXPECT_LT(blue.g, 100) << format;
  }
}

TEST_F(Vivid, RateThatItLacksIsTold) {
  V4l2Driver driver({nodes_[0].bus, 640, 480, 1000}, {.format = "YUYV"});
  driver.Start();
  EXPECT_LT(driver.Facts().fps, 1000);
  EXPECT_THAT(driver.Facts().remarks, ::testing::Contains(HasSubstr("set fps = ")));
}

TEST_F(Vivid, GainIsSetAndReadBack) {
  V4l2Driver driver({nodes_[0].bus, 320, 180, 25}, {.format = "GREY", .gain = 300});
  driver.Start();
  EXPECT_THAT(driver.Facts().remarks,
              ::testing::ElementsAre(HasSubstr("gain: requested 300, the camera set 255")));
}

TEST_F(Vivid, StampsAreTheKernels) {
  V4l2Driver driver = VividDriver(nodes_[0]);
  driver.Start();
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  EXPECT_THAT(driver.Facts().time_source, HasSubstr("kernel"));
  // vivid's own frame clock may be a frame ahead.
  EXPECT_LT(std::abs(TimelineNs() - frame_.capture_ns), 5'000'000'000);
}

TEST_F(Vivid, CaptureTimesGoOnWhenTheHostsClockIsSet) {
  V4l2Driver driver = VividDriver(nodes_[0]);
  driver.Start();
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  std::int64_t last_ns = frame_.capture_ns;
  for (const double step_s : {-3600.0, -0.8, 0.8, 3600.0}) {
    const std::int64_t set_ns = TimeOfDayNs() + std::llround(step_s * 1e9);
    const timespec time{set_ns / 1'000'000'000, set_ns % 1'000'000'000};
    ASSERT_EQ(clock_settime(CLOCK_REALTIME, &time), 0);
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
      EXPECT_GT(frame_.capture_ns, last_ns) << step_s;
      EXPECT_LT(frame_.capture_ns - last_ns, 2'000'000'000) << step_s;
      last_ns = frame_.capture_ns;
    }
  }
}

TEST_F(Vivid, AllCamerasStreamAtOnce) {
  struct Count {
    int frames = 0;
    std::uint64_t taken = 0;
    double seconds = 0;
  };
  std::vector<std::future<Count>> counting;
  for (const V4l2Node& node : nodes_) {
    counting.push_back(std::async(std::launch::async, [&node] {
      V4l2Driver driver({node.bus, 640, 480, 25}, {.format = "GREY"});
      driver.Start();
      Count count;
      Frame first, frame;
      while (driver.Grab(first, kKernelTimeout) != GrabStatus::kFrame) continue;
      while (count.frames < 125 && driver.Grab(frame, kKernelTimeout) != GrabStatus::kLost) {
        ++count.frames;
      }
      count.taken = frame.sequence - first.sequence;
      count.seconds = static_cast<double>(frame.capture_ns - first.capture_ns) / 1e9;
      return count;
    }));
  }
  for (auto& counted : counting) {
    const Count count = counted.get();
    std::printf("640x480: %.2f frames a second, %d of %d lost\n", count.frames / count.seconds,
                static_cast<int>(count.taken) - count.frames, static_cast<int>(count.taken));
    EXPECT_EQ(count.frames, 125);
  }
}

TEST_F(Vivid, DroppedBuffersAreGapsInTheSequence) {
  V4l2Driver driver = VividDriver(nodes_[0]);
  driver.Start();
  SetControl(nodes_[0], "Percentage of Dropped Buffers", 40);
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  const std::uint64_t first = frame_.sequence;
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  SetControl(nodes_[0], "Percentage of Dropped Buffers", 0);
  EXPECT_GT(frame_.sequence - first, 45u);
}

TEST_F(Vivid, ErrorBufferIsTornAndFramesGoOn) {
  V4l2Driver driver = VividDriver(nodes_[0]);
  driver.Start();
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  SetControl(nodes_[0], "Inject V4L2_BUF_FLAG_ERROR", 1);
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kTorn));
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
}

TEST_F(Vivid, BuffersOrStreamThatFailOnceAreASetupErrorAndThenWork) {
  for (const char* injection : {"Inject VIDIOC_REQBUFS Error", "Inject VIDIOC_STREAMON Error"}) {
    V4l2Driver driver = VividDriver(nodes_[0]);
    SetControl(nodes_[0], injection, 1);
    EXPECT_FALSE(Starts(driver)) << injection;
    EXPECT_TRUE(Starts(driver)) << injection;
    EXPECT_TRUE(GrabUntil(driver, GrabStatus::kFrame)) << injection;
  }
}

TEST_F(Vivid, FailedStreamIsBegunAgainWhileOthersGoOn) {
  for (const char* injection : {"Inject Fatal Streaming Error", "Inject VIDIOC_QBUF Error"}) {
    V4l2Driver driver = VividDriver(nodes_[0]), other = VividDriver(nodes_[1]);
    driver.Start();
    other.Start();
    ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
    SetControl(nodes_[0], injection, 1);
    EXPECT_TRUE(GrabUntil(driver, GrabStatus::kLost)) << injection;
    EXPECT_TRUE(GrabUntil(other, GrabStatus::kFrame)) << injection;
    EXPECT_TRUE(GrabUntil(driver, GrabStatus::kFrame)) << injection;
  }
}

TEST_F(Vivid, DisconnectedCameraIsLostAndReturnsWhileOthersGoOn) {
  V4l2Driver driver = VividDriver(nodes_[0]), other = VividDriver(nodes_[1]);
  driver.Start();
  other.Start();
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  SetControl(nodes_[0], "Disconnect", 1);
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kLost));
  EXPECT_TRUE(GrabUntil(other, GrabStatus::kFrame));
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
}

TEST_F(Vivid, UnboundCamerasAreLostAndReturnOnceTheyAreBoundAgain) {
  const std::string folder = "/sys/bus/platform/drivers/vivid/";
  V4l2Driver driver = VividDriver(nodes_[0]);
  driver.Start();
  ASSERT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  const std::uint64_t before = frame_.sequence;
  std::ofstream(folder + "unbind") << "vivid.0" << std::flush;
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kLost));
  EXPECT_FALSE(GrabUntil(driver, GrabStatus::kFrame));
  EXPECT_THAT(driver.Facts().remarks, ::testing::Contains(HasSubstr("no camera")));
  std::ofstream(folder + "bind") << "vivid.0" << std::flush;
  EXPECT_TRUE(GrabUntil(driver, GrabStatus::kFrame));
  EXPECT_GT(frame_.sequence, before);
}

}  // namespace
}  // namespace mocap::testing
