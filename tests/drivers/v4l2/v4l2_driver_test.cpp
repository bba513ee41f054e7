#include "drivers/v4l2/v4l2_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <memory>
#include <string>

#include "core/errors.h"
#include "tests/drivers/driver_suite.h"
#include "tests/support/fake_machine.h"

namespace mocap::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::chrono::milliseconds kTimeout{100};

struct V4l2Factory {
  static constexpr bool kEnds = false;
  std::string WhySkip() { return ""; }
  std::unique_ptr<CameraDriver> Make() {
    const int number = made_++;
    machine_.Plug(number, "serial" + std::to_string(number), std::to_string(number));
    return std::make_unique<V4l2Driver>(CameraRequest{machine_.Node(number), 64, 48, 30},
                                        V4l2Settings{}, machine_.kernel, machine_.tree);
  }

  FakeMachine machine_;
  int made_ = 0;
};
INSTANTIATE_TYPED_TEST_SUITE_P(V4l2, CameraDriverSuite, V4l2Factory);

class V4l2 : public ::testing::Test {
 protected:
  std::string StartError(const std::string& device, const V4l2Settings& settings = {}) {
    try {
      V4l2Driver driver = machine_.Driver(device, settings);
      driver.Start();
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  GrabStatus GrabPast(V4l2Driver& driver, GrabStatus weather) {
    GrabStatus status = weather;
    for (int i = 0; i < 100 && status == weather; ++i) status = driver.Grab(frame_, kTimeout);
    return status;
  }

  FakeMachine machine_;
  Frame frame_;
};

TEST_F(V4l2, IsFoundByNodeLinkBusAndSerial) {
  machine_.Plug(0, "A1", "1");
  machine_.Plug(4, "B2", "2.3");
  const std::string link = machine_.Link("usb-Fake_B2-video-index0", 4);
  for (const std::string& name :
       {machine_.Node(4), link, std::string("usb-0000:00:14.0-2.3"), std::string("B2")}) {
    EXPECT_EQ(FindV4l2Node(*machine_.kernel, name, machine_.tree).path, machine_.Node(4)) << name;
  }
}

TEST_F(V4l2, NamesOfNothingAndOfSeveralAreRefused) {
  machine_.Plug(0, "same", "1");
  machine_.Plug(2, "same", "2");
  EXPECT_THAT(StartError("same"),
              AllOf(HasSubstr("several"), HasSubstr("video0"), HasSubstr("video2")));
  EXPECT_THAT(StartError("other"), AllOf(HasSubstr("other"), HasSubstr("video2")));
  EXPECT_THAT(StartError("/dev/v4l/by-id/absent"), HasSubstr("does not exist"));
  EXPECT_THAT(StartError(machine_.Link("usb-Twin-video-index0", 2, 2)), HasSubstr("several"));
  EXPECT_EQ(StartError(machine_.Link("usb-Single-video-index0", 2, 1)), "none");
}

TEST_F(V4l2, NodesForMetadataAreNoCameras) {
  machine_.Plug(0, "A1");
  machine_.Plug(1, "A1").capabilities = V4L2_CAP_META_CAPTURE | V4L2_CAP_STREAMING;
  EXPECT_THAT(FindV4l2Nodes(*machine_.kernel, machine_.tree), SizeIs(1));
  EXPECT_EQ(StartError("A1"), "none");
  EXPECT_THAT(StartError(machine_.Node(1)), AllOf(HasSubstr("no pictures"), HasSubstr("video0")));
}

TEST_F(V4l2, ListNamesEachCameraByWhatLastsLongest) {
  machine_.Plug(0, "A1", "1");
  machine_.Plug(2, "", "2");
  machine_.Plug(10, "", "3");
  machine_.Plug(11, "", "3");
  const std::string link = machine_.Link("usb-Fake_A1-video-index0", 0);
  const auto cameras = ListV4l2Cameras(*machine_.kernel, machine_.tree);
  ASSERT_EQ(cameras.size(), 4u);
  EXPECT_EQ(cameras[0].device, link);
  EXPECT_EQ(cameras[0].serial, "A1");
  EXPECT_EQ(cameras[0].link_mbit_s, 480);
  EXPECT_THAT(cameras[0].formats, ElementsAre("YUYV 64x48@60"));
  EXPECT_EQ(cameras[1].device, "usb-0000:00:14.0-2");
  EXPECT_EQ(cameras[2].device, machine_.Node(10));
}

TEST_F(V4l2, TakesTheFirstFormatThatKeepsTheRate) {
  FakeCamera& camera = machine_.Plug(0);
  camera.modes = {{V4L2_PIX_FMT_MJPEG, 64, 48, {30}},
                  {V4L2_PIX_FMT_UYVY, 64, 48, {30}},
                  {V4L2_PIX_FMT_YUYV, 64, 48, {10}},
                  {V4L2_PIX_FMT_YUYV, 32, 24, {60}}};
  EXPECT_EQ(StartError(machine_.Node(0)), "none");
  EXPECT_EQ(camera.fourcc, static_cast<int>(V4L2_PIX_FMT_UYVY));
  EXPECT_EQ(camera.fps, 30);
  EXPECT_EQ(StartError(machine_.Node(0), {.format = "YUYV"}), "none");
  EXPECT_EQ(camera.fourcc, static_cast<int>(V4L2_PIX_FMT_YUYV));
  camera.enumerates = false;
  EXPECT_EQ(StartError(machine_.Node(0)), "none");
}

TEST_F(V4l2, SizeOrFormatThatItLacksIsAnErrorThatTellsWhatItHas) {
  machine_.Plug(0).modes = {{V4L2_PIX_FMT_YUYV, 32, 24, {60}}};
  EXPECT_THAT(StartError(machine_.Node(0)), AllOf(HasSubstr("64x48"), HasSubstr("32x24")));
  EXPECT_THAT(StartError(machine_.Node(0), {.format = "MJPG"}), HasSubstr("MJPG"));
  machine_.kernel->cameras.at(machine_.Node(0)).enumerates = false;
  EXPECT_THAT(StartError(machine_.Node(0)), AllOf(HasSubstr("64x48"), HasSubstr("32x24")));
}

TEST_F(V4l2, AnotherRateThanAskedForIsTold) {
  machine_.Plug(0).modes = {{V4L2_PIX_FMT_YUYV, 64, 48, {25, 5}}};
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  EXPECT_EQ(driver.Facts().fps, 25);
  EXPECT_THAT(driver.Facts().remarks,
              ElementsAre(AllOf(HasSubstr("fps: requested 30"), HasSubstr("set fps = 25"))));
}

TEST_F(V4l2, SettingsAreManualAndReadBack) {
  FakeCamera& camera = machine_.Plug(0);
  camera.controls = {{V4L2_CID_EXPOSURE_AUTO, {0, 3, V4L2_EXPOSURE_APERTURE_PRIORITY}},
                     {V4L2_CID_EXPOSURE_AUTO_PRIORITY, {0, 1, 1}},
                     {V4L2_CID_EXPOSURE_ABSOLUTE, {3, 2047, 250}},
                     {V4L2_CID_AUTOGAIN, {0, 1, 1}},
                     {V4L2_CID_GAIN, {0, 100, 64}},
                     {V4L2_CID_AUTO_WHITE_BALANCE, {0, 1, 1}},
                     {V4L2_CID_POWER_LINE_FREQUENCY, {0, 2, 2}}};
  V4l2Driver driver = machine_.Driver(
      machine_.Node(0), {.exposure_us = 8000, .gain = 120, .focus = 5, .power_line_hz = 50});
  driver.Start();
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO].value, V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_AUTO_PRIORITY].value, 0);
  EXPECT_EQ(camera.controls[V4L2_CID_EXPOSURE_ABSOLUTE].value, 80);
  EXPECT_EQ(camera.controls[V4L2_CID_AUTOGAIN].value, 0);
  EXPECT_EQ(camera.controls[V4L2_CID_POWER_LINE_FREQUENCY].value, 1);
  EXPECT_THAT(driver.Facts().remarks,
              ElementsAre(AllOf(HasSubstr("gain: requested 120, the camera set 100"),
                                HasSubstr("0 to 100")),
                          HasSubstr("set white_balance_k"), HasSubstr("focus: the camera has no")));
}

TEST_F(V4l2, LostBandwidthPermissionAndBusyCamerasAreExplained) {
  FakeCamera& camera = machine_.Plug(0, "", "1.2");
  camera.stream_error = ENOSPC;
  EXPECT_THAT(StartError(machine_.Node(0)), AllOf(HasSubstr("bandwidth of usb-0000:00:14.0 "),
                                                  HasSubstr("set format = \"MJPG\"")));
  camera.modes = {{V4L2_PIX_FMT_MJPEG, 64, 48, {30}}};
  EXPECT_THAT(StartError(machine_.Node(0)), HasSubstr("with MJPG; set a lower fps"))
      << "what is set already is not asked for";
  camera.stream_error = 0;
  camera.buffers_error = EBUSY;
  EXPECT_THAT(StartError(machine_.Node(0)), HasSubstr("in use"));
  camera.buffers_error = 0;
  camera.format_error = EBUSY;
  EXPECT_THAT(StartError(machine_.Node(0)), HasSubstr("in use"));
  camera.open_error = EACCES;
  EXPECT_THAT(StartError(machine_.Node(0)), HasSubstr("group `video`"));
  EXPECT_EQ(camera.handles, 0);
}

TEST_F(V4l2, GapsAreInTheSequenceAndDamagedBuffersAreTorn) {
  FakeCamera& camera = machine_.Plug(0);
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  const std::uint64_t first = frame_.sequence;
  camera.skips = {0, 3};
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  EXPECT_EQ(frame_.sequence, first + 1);
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  EXPECT_EQ(frame_.sequence, first + 5);
  camera.error_buffers = 1;
  camera.short_buffers = 2;
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kTorn);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kTorn);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  EXPECT_EQ(frame_.sequence, first + 8);
  // Far more of either than there are buffers.
  camera.error_buffers = 20;
  EXPECT_EQ(GrabPast(driver, GrabStatus::kTorn), GrabStatus::kFrame);
}

TEST_F(V4l2, SequenceGoesOnWhereTheKernelsStandsStillOrWraps) {
  FakeCamera& camera = machine_.Plug(0);
  camera.counts = false;
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  for (std::uint64_t i = 1; i < 4; ++i) {
    ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
    EXPECT_EQ(frame_.sequence, i);
  }
  camera.counts = true;
  camera.skips = {0xffffffffu - 3};
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  const std::uint64_t before = frame_.sequence;
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  EXPECT_EQ(frame_.sequence, before + 1);
}

TEST_F(V4l2, UnpluggedCameraIsLostAndReturnsByItsSerialUnderAnotherNumber) {
  machine_.Plug(0, "A1");
  V4l2Driver driver = machine_.Driver("A1");
  driver.Start();
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  const Frame last = frame_;
  machine_.Unplug(0);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kLost);
  EXPECT_EQ(machine_.kernel->cameras.at(machine_.Node(0)).handles, 0);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kLost);
  EXPECT_THAT(driver.Facts().remarks, Contains(HasSubstr("A1: no camera has")));
  machine_.Plug(3, "A1");
  GrabPast(driver, GrabStatus::kLost);
  ASSERT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  EXPECT_EQ(driver.Facts().device, machine_.Node(3));
  EXPECT_GT(frame_.sequence, last.sequence);
  EXPECT_GT(frame_.capture_ns, last.capture_ns);
}

TEST_F(V4l2, AnotherCameraUnderTheSameNumberIsNotTakenForIt) {
  machine_.Plug(0, "A1");
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  machine_.Unplug(0);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kLost);
  fs::remove_all(machine_.tree.sys / "devices");
  machine_.Plug(0, "B2").is_plugged_in = true;
  for (int i = 0; i < 4; ++i) EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kLost);
  EXPECT_THAT(driver.Facts().remarks, Contains(HasSubstr("a different camera, B2")));
}

TEST_F(V4l2, BrokenStreamIsBegunAgain) {
  FakeCamera& camera = machine_.Plug(0, "A1");
  V4l2Driver driver = machine_.Driver("A1");
  driver.Start();
  camera.dequeue_error = EIO;
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kLost);
  camera.dequeue_error = 0;
  EXPECT_EQ(GrabPast(driver, GrabStatus::kLost), GrabStatus::kTimeout);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  // What the camera does otherwise is told once, not once for each time it returned.
  EXPECT_THAT(driver.Facts().remarks, IsEmpty());
}

TEST_F(V4l2, NothingInTimeIsATimeout) {
  machine_.Plug(0).empty_waits = 2;
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kTimeout);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kTimeout);
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
}

TEST_F(V4l2, RowsThatCannotBeSoShortAreToldAndReadWithoutGaps) {
  machine_.Plug(0).told_stride = 2;
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  EXPECT_EQ(driver.Grab(frame_, kTimeout), GrabStatus::kFrame);
  EXPECT_THAT(driver.Facts().remarks, Contains(HasSubstr("reports rows of 2 bytes")));
}

TEST_F(V4l2, TellsWhereItsTimesComeFrom) {
  FakeCamera& camera = machine_.Plug(0);
  V4l2Driver driver = machine_.Driver(machine_.Node(0));
  driver.Start();
  driver.Grab(frame_, kTimeout);
  EXPECT_EQ(driver.Facts().time_source, "kernel, start of exposure");
  camera.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  driver.Grab(frame_, kTimeout);
  EXPECT_EQ(driver.Facts().time_source, "kernel, end of frame");
  camera.flags = 0;
  camera.stamp_offset_ns = 3'600'000'000'000;
  driver.Grab(frame_, kTimeout);
  EXPECT_EQ(driver.Facts().time_source, "arrival");
  EXPECT_THAT(driver.Facts().remarks, Contains(HasSubstr("arrival")));
}

constexpr ClockReading kNow{
    .monotonic_ns = 50'000'000'000, .time_of_day_ns = 1'700'000'000'000'000'000, .width_ns = 0};
constexpr std::int64_t kAge_ns = 40'000'000, kExposure_ns = 8'000'000;

TEST(V4l2Time, StampsAreMovedToTheMiddleOfTheExposureAndToTheEpoch) {
  HostClock host([] { return kNow; });
  const std::int64_t stamp_ns = kNow.monotonic_ns - kAge_ns;
  const CaptureTime start =
      CaptureTimeOf(stamp_ns, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE,
                    kExposure_ns, host);
  EXPECT_EQ(start.capture_ns, kNow.time_of_day_ns - kAge_ns + kExposure_ns / 2);
  EXPECT_EQ(start.clock, V4l2Clock::kMonotonic);
  const CaptureTime end =
      CaptureTimeOf(stamp_ns, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC, kExposure_ns, host);
  EXPECT_EQ(end.capture_ns, kNow.time_of_day_ns - kAge_ns - kExposure_ns / 2);
}

TEST(V4l2Time, StampsWithoutAClockAreHeldAgainstTheKernelsClocks) {
  HostClock host([] { return kNow; });
  const CaptureTime monotonic = CaptureTimeOf(kNow.monotonic_ns - kAge_ns, 0, 0, host);
  EXPECT_EQ(monotonic.capture_ns, kNow.time_of_day_ns - kAge_ns);
  EXPECT_EQ(monotonic.clock, V4l2Clock::kGuessed);
  const CaptureTime epoch = CaptureTimeOf(kNow.time_of_day_ns - kAge_ns, 0, 0, host);
  EXPECT_EQ(epoch.capture_ns, kNow.time_of_day_ns - kAge_ns);
  const CaptureTime none = CaptureTimeOf(7, 0, 0, host);
  EXPECT_EQ(none.capture_ns, kNow.time_of_day_ns);
  EXPECT_EQ(none.clock, V4l2Clock::kArrival);
}

TEST(V4l2Time, CaptureTimesDoNotStepWithTheTimeOfDay) {
  for (const std::int64_t step_ns : {-3'600'000'000'000L, -800'000'000L, 800'000'000L}) {
    ClockReading now = kNow;
    HostClock host([&now] { return now; });
    now.time_of_day_ns += step_ns;
    const CaptureTime monotonic = CaptureTimeOf(now.monotonic_ns - kAge_ns, 0, 0, host);
    EXPECT_EQ(monotonic.capture_ns, kNow.time_of_day_ns - kAge_ns) << step_ns;
    const CaptureTime epoch = CaptureTimeOf(now.time_of_day_ns - kAge_ns, 0, 0, host);
    EXPECT_EQ(epoch.capture_ns, kNow.time_of_day_ns - kAge_ns) << step_ns;
  }
}

}  // namespace
}  // namespace mocap::testing
