#include "drivers/aravis/aravis_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "drivers/aravis/aravis_directory.h"
#include "drivers/aravis/gige_action.h"
#include "tests/drivers/driver_suite.h"
#include "tests/support/pattern_camera.h"
#include "tests/support/private_network.h"
#include "tools/gige/gige_camera.h"
#include "tools/gige/gige_description.h"
#include "tools/gige/loopback.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::PatternCamera;

constexpr int kWidth_px = 160, kHeight_px = 120;
constexpr double kFps = 100;
constexpr std::int64_t kPeriod_ns = 10'000'000;
constexpr milliseconds kPatience{3000};

/// Threads of other tests in this process would keep it from getting a network of its own.
[[maybe_unused]] const bool kNetworkIsEntered = testing::EnterPrivateNetwork().empty();

std::string WhyNoNetwork() { return testing::EnterPrivateNetwork(); }

/// Each test's cameras have addresses of their own: sockets of the last one may linger.
std::string NextAddress() {
  static int used = 0;
  const std::string ip = AddressAfter("127.0.0.11", used++);
  EXPECT_TRUE(EnsureLoopbackAddress(ip));
  return ip;
}

std::unique_ptr<GigeCamera> Serve(const std::string& ip, const GigeFaults& faults = {},
                                  bool has_ptp = false, double fps = kFps) {
  return std::make_unique<GigeCamera>(
      GigeIdentity{ip, "name" + ip.substr(8), "SN" + ip.substr(8), has_ptp},
      std::make_unique<PatternCamera>(kWidth_px, kHeight_px, fps), faults);
}

CameraRequest Request(const std::string& device, double fps = kFps) {
  return {device, kWidth_px, kHeight_px, fps};
}

AravisSettings Settings(const std::string& format = "BGR8") {
  AravisSettings settings;
  settings.format = format;
  settings.exposure_us = 2000;
  settings.packet_bytes = 9000;
  return settings;
}

class AravisDriverTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = WhyNoNetwork(); !reason.empty()) GTEST_SKIP() << reason;
  }
};

/// Grabs until a frame comes; none in time is a failure.
bool GrabFrame(AravisDriver& driver, Frame& frame, milliseconds patience = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    if (driver.Grab(frame, milliseconds(50)) == GrabStatus::kFrame) return true;
  }
  return false;
}

/// Grabs until something else than a frame is said.
GrabStatus GrabUntil(AravisDriver& driver, GrabStatus wanted) {
  Frame frame;
  GrabStatus status = GrabStatus::kFrame;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (status != wanted && std::chrono::steady_clock::now() < deadline) {
    status = driver.Grab(frame, milliseconds(50));
  }
  return status;
}

/// How far a capture time lies from the multiples of the period at which pictures were taken.
std::int64_t OffBeat_ns(std::int64_t capture_ns) {
  const std::int64_t rest = capture_ns % kPeriod_ns;
  return std::min(rest, kPeriod_ns - rest);
}

/// Whether a picture is the one that was taken at its capture time.
bool IsOfItsTime(const Frame& frame) {
  const std::int64_t beat = (frame.capture_ns + kPeriod_ns / 2) / kPeriod_ns;
  return frame.image(0, 0).g == PatternCamera::GreyAt(beat);
}

std::string WhyNotStarted(AravisDriver& driver) {
  try {
    driver.Start();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

TEST_F(AravisDriverTest, EveryFormatGivesTheSamePicture) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  for (const std::string format :
       {"BGR8", "RGB8", "Mono8", "BayerRG8", "BayerGR8", "BayerGB8", "BayerBG8"}) {
    AravisDriver driver(Request(ip), Settings(format));
    driver.Start();
    Frame frame;
    ASSERT_TRUE(GrabFrame(driver, frame)) << format;
    EXPECT_EQ(frame.image.width(), kWidth_px);
    EXPECT_EQ(frame.image.height(), kHeight_px);
    EXPECT_TRUE(PatternCamera::IsPattern(frame.image)) << format;
    EXPECT_EQ(driver.Facts().format, format);
    driver.Stop();
  }
}

TEST_F(AravisDriverTest, Yuv422IsAsBrightAsItWas) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  for (const std::string format : {"YUV422_8", "YUV422_8_UYVY"}) {
    AravisDriver driver(Request(ip), Settings(format));
    driver.Start();
    Frame frame;
    ASSERT_TRUE(GrabFrame(driver, frame)) << format;
    EXPECT_EQ(frame.image(0, 0), frame.image(kWidth_px - 1, kHeight_px - 1));
    EXPECT_NEAR(frame.image(0, 0).g, frame.image(0, 0).b, 3);
    EXPECT_GE(frame.image(0, 0).g, 30);
    driver.Stop();
  }
}

TEST_F(AravisDriverTest, PicksTheLeanestFormatThatHasColour) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisDriver driver(Request(ip), Settings(""));
  driver.Start();
  EXPECT_EQ(driver.Facts().format, "BayerRG8");
}

TEST_F(AravisDriverTest, CamerasAreFoundByNameAndSerialNumber) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  for (const std::string& device : {"name" + ip.substr(8), "SN" + ip.substr(8)}) {
    const AravisTarget target = FindAravisCamera(device);
    EXPECT_EQ(target.ip, ip) << device;
  }
}

TEST_F(AravisDriverTest, WhatCannotBeHadIsToldAtOnce) {
  const std::string ip = NextAddress();
  AravisDriver nobody(Request(ip), Settings());
  EXPECT_THAT(WhyNotStarted(nobody), HasSubstr("no GigE Vision camera answers at " + ip));
  const auto camera = Serve(ip);
  AravisDriver odd(Request(ip), Settings("BayerRG12"));
  EXPECT_THAT(WhyNotStarted(odd), HasSubstr("Mono8"));
  AravisSettings settings = Settings();
  settings.trigger = "Line7";
  AravisDriver triggered(Request(ip), settings);
  EXPECT_THAT(WhyNotStarted(triggered), HasSubstr("Line0"));
  settings = Settings();
  settings.strobe = "Line7";
  AravisDriver master(Request(ip), settings);
  EXPECT_EQ(WhyNotStarted(master), ip + ": strobe \"Line7\" cannot be set: it has Line0, Line1");
}

TEST_F(AravisDriverTest, ValuesThatTheCameraDoesNotTakeAreTold) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisSettings settings = Settings();
  settings.gain = 3;
  settings.exposure_us = 20.6;
  AravisDriver driver(Request(ip), settings);
  driver.Start();
  // This one exposes for whole microseconds.
  EXPECT_THAT(driver.Facts().remarks,
              Contains(HasSubstr("exposes for 20 us; asked for were 20.6")));
  EXPECT_THAT(driver.Facts().remarks, Not(Contains(HasSubstr("gain"))));
  driver.Stop();
  settings.exposure_us = 15'000;
  AravisDriver blurred(Request(ip), settings);
  blurred.Start();
  EXPECT_THAT(blurred.Facts().remarks, Contains(HasSubstr("longer than a frame lasts")));
}

TEST_F(AravisDriverTest, CaptureTimesAreTheHostsWhateverTheCamerasClockSays) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip, {.clock_offset_ns = -600'000'000'000, .clock_drift_ppm = 50});
  AravisDriver driver(Request(ip), Settings());
  driver.Start();
  Frame frame;
  for (int i = 0; i < 50; ++i) ASSERT_TRUE(GrabFrame(driver, frame));
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(GrabFrame(driver, frame));
    EXPECT_TRUE(IsOfItsTime(frame));
  }
  EXPECT_EQ(driver.Facts().time_source, "device clock, fitted");
}

TEST_F(AravisDriverTest, PtpInTaiIsRecognizedAndExact) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip, {}, true);
  AravisDriver driver(Request(ip), Settings());
  driver.Start();
  Frame frame;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (driver.Facts().time_source != "PTP, TAI" && std::chrono::steady_clock::now() < deadline) {
    ASSERT_TRUE(GrabFrame(driver, frame));
  }
  ASSERT_TRUE(GrabFrame(driver, frame));
  EXPECT_EQ(driver.Facts().time_source, "PTP, TAI");
  EXPECT_LE(OffBeat_ns(frame.capture_ns), 1000);
}

TEST_F(AravisDriverTest, LostPacketsTearFramesAndAreCounted) {
  const std::string ip = NextAddress();
  // Nine packets a frame.
  const auto camera = Serve(ip, {.lost_packets = 0.03});
  AravisDriver driver(Request(ip), Settings());
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  const Frame first = frame;
  int whole = 0, torn = 0;
  for (int i = 0; i < 400 && (whole < 50 || torn < 5); ++i) {
    const GrabStatus status = driver.Grab(frame, milliseconds(100));
    if (status == GrabStatus::kTorn) ++torn;
    if (status != GrabStatus::kFrame) continue;
    ++whole;
    EXPECT_TRUE(PatternCamera::IsPattern(frame.image));
    // Numbers keep step with the time, whatever was lost.
    const auto frames = static_cast<double>(frame.sequence - first.sequence);
    EXPECT_LT(frames * kPeriod_ns, frame.capture_ns - first.capture_ns + 5 * kPeriod_ns);
  }
  EXPECT_GE(whole, 50);
  EXPECT_GE(torn, 5);
  EXPECT_THAT(driver.Facts().damage, HasSubstr("packets are missing"));
}

TEST_F(AravisDriverTest, SoftwareTriggerKeepsTheRateAskedFor) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisSettings settings = Settings();
  settings.trigger = "software";
  AravisDriver driver(Request(ip, 20), settings);
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  const std::int64_t first_ns = frame.capture_ns;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(GrabFrame(driver, frame));
  EXPECT_GT(frame.capture_ns - first_ns, 10 * 50'000'000 - 100'000'000);
}

TEST_F(AravisDriverTest, ScheduledExposuresComeAtMultiplesOfThePeriodByPtp) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip, {}, true);
  AravisSettings settings = Settings();
  settings.trigger = "ptp";
  AravisDriver driver(Request(ip, kFps / 2), settings);
  driver.Start();
  EXPECT_EQ(camera->Read(gige_register::kTriggerSource),
            static_cast<unsigned>(GigeTrigger::kAction1));
  EXPECT_EQ(camera->Read(gige_register::kActionDeviceKey), GigeActionKeys().device);
  EXPECT_EQ(camera->Read(gige_register::kActionGroupMask), GigeActionKeys().mask);
  Frame frame;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (driver.Facts().time_source != "PTP, TAI" && std::chrono::steady_clock::now() < deadline) {
    ASSERT_TRUE(GrabFrame(driver, frame));
  }
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(GrabFrame(driver, frame));
    // TAI is a whole number of seconds ahead.
    EXPECT_LE((frame.capture_ns + 1000) % (2 * kPeriod_ns), 2000);
    EXPECT_TRUE(IsOfItsTime(frame));
  }
  EXPECT_THAT(driver.Facts().remarks, Not(Contains(HasSubstr("PTP"))));
  EXPECT_THAT(driver.Facts().remarks, Not(Contains(HasSubstr("ahead"))));
}

TEST_F(AravisDriverTest, SchedulingNeedsPtpAndSaysWhenThereIsNoMaster) {
  AravisSettings settings = Settings();
  settings.trigger = "ptp";
  const std::string ip = NextAddress(), lonely_ip = NextAddress();
  const auto without = Serve(ip);
  AravisDriver refused(Request(ip), settings);
  EXPECT_EQ(WhyNotStarted(refused),
            ip + ": trigger \"ptp\" cannot be set: a GigE Vision camera that "
                 "tells its PTP status is wanted");
  const auto lonely = Serve(lonely_ip, {.has_no_ptp_master = true}, true);
  AravisDriver driver(Request(lonely_ip), settings);
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  EXPECT_THAT(
      driver.Facts().remarks,
      Contains(HasSubstr("without a master on its network it is triggered by its own clock, "
                         "out of step")));
}

TEST_F(AravisDriverTest, LineTriggerFollowsTheLine) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisSettings settings = Settings();
  settings.trigger = "Line0";
  AravisDriver driver(Request(ip, 20), settings);
  driver.Start();
  Frame before, frame;
  ASSERT_TRUE(GrabFrame(driver, before));
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(GrabFrame(driver, frame));
    EXPECT_GT(frame.sequence, before.sequence);
  }
}

TEST_F(AravisDriverTest, StrobeIsAnOutputThatTellsOfTheExposure) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisSettings settings = Settings();
  settings.trigger = "Line0";
  settings.strobe = "Line1";
  AravisDriver driver(Request(ip), settings);
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  const auto line_1 = [&camera](std::uint32_t of_line_0) { return camera->Read(of_line_0 + 4); };
  EXPECT_EQ(camera->Read(gige_register::kLineMode), static_cast<unsigned>(GigeLine::kInput));
  EXPECT_EQ(line_1(gige_register::kLineMode), static_cast<unsigned>(GigeLine::kOutput));
  EXPECT_EQ(line_1(gige_register::kLineSource),
            static_cast<unsigned>(GigeLineSource::kExposureActive));
  driver.Stop();
  // What was an output is an input again.
  settings.trigger = "";
  settings.strobe = "Line0";
  AravisDriver master(Request(ip), settings);
  master.Start();
  EXPECT_EQ(camera->Read(gige_register::kLineMode), static_cast<unsigned>(GigeLine::kOutput));
  master.Stop();
  settings.trigger = "Line0";
  settings.strobe = "";
  AravisDriver triggered(Request(ip), settings);
  triggered.Start();
  EXPECT_EQ(camera->Read(gige_register::kLineMode), static_cast<unsigned>(GigeLine::kInput));
}

TEST_F(AravisDriverTest, CameraThatWaitsForItsTriggerIsNotLost) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisSettings settings = Settings();
  settings.trigger = "Line0";
  AravisDriver driver(Request(ip), settings);
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  camera->Stall(true);
  ASSERT_EQ(GrabUntil(driver, GrabStatus::kTimeout), GrabStatus::kTimeout);
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(driver.Grab(frame, milliseconds(50)), GrabStatus::kTimeout);
  camera->Stall(false);
  EXPECT_TRUE(GrabFrame(driver, frame));
}

TEST_F(AravisDriverTest, StalledCameraIsLostAndGoesOnByItself) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisDriver driver(Request(ip), Settings());
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  const std::int64_t before_ns = frame.capture_ns;
  camera->Stall(true);
  EXPECT_EQ(GrabUntil(driver, GrabStatus::kLost), GrabStatus::kLost);
  camera->Stall(false);
  ASSERT_TRUE(GrabFrame(driver, frame));
  EXPECT_GT(frame.capture_ns, before_ns);
}

TEST_F(AravisDriverTest, LinkThatWasCutForASecondIsSurvived) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisDriver driver(Request(ip), Settings());
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  const std::int64_t before_ns = frame.capture_ns;
  {
    const testing::LinkCut cut;
    EXPECT_EQ(GrabUntil(driver, GrabStatus::kLost), GrabStatus::kLost);
    EXPECT_FALSE(GrabFrame(driver, frame, milliseconds(1000)));
  }
  ASSERT_TRUE(GrabFrame(driver, frame));
  EXPECT_GT(frame.capture_ns, before_ns);
  EXPECT_TRUE(PatternCamera::IsPattern(frame.image));
}

TEST_F(AravisDriverTest, CameraThatWasSwitchedOffIsLostAndReturns) {
  const std::string ip = NextAddress();
  auto camera = Serve(ip);
  AravisDriver driver(Request(ip), Settings());
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  const std::int64_t before_ns = frame.capture_ns;
  const std::uint64_t before = frame.sequence;
  camera.reset();
  EXPECT_EQ(GrabUntil(driver, GrabStatus::kLost), GrabStatus::kLost);
  camera = Serve(ip);
  ASSERT_TRUE(GrabFrame(driver, frame));
  EXPECT_GT(frame.capture_ns, before_ns);
  EXPECT_GT(frame.sequence, before);
  EXPECT_TRUE(PatternCamera::IsPattern(frame.image));
}

TEST_F(AravisDriverTest, HalfTheRateIsHalfTheFrames) {
  const std::string ip = NextAddress();
  const auto camera = Serve(ip);
  AravisDriver driver(Request(ip, kFps / 2), Settings());
  driver.Start();
  Frame frame;
  ASSERT_TRUE(GrabFrame(driver, frame));
  for (int i = 0; i < 20; ++i) {
    const int before = frame.image(0, 0).g;
    ASSERT_TRUE(GrabFrame(driver, frame));
    EXPECT_NE(frame.image(0, 0).g, before);
    EXPECT_NE(frame.image(0, 0).g, before + 1);
  }
}

struct AravisFactory {
  static constexpr bool kEnds = false;
  std::string WhySkip() { return WhyNoNetwork(); }
  std::unique_ptr<CameraDriver> Make() {
    const std::string ip = NextAddress();
    cameras.push_back(Serve(ip));
    return std::make_unique<AravisDriver>(Request(ip), Settings());
  }
  std::vector<std::unique_ptr<GigeCamera>> cameras;
};

}  // namespace

namespace testing {
INSTANTIATE_TYPED_TEST_SUITE_P(Aravis, CameraDriverSuite, AravisFactory);
}  // namespace testing
}  // namespace mocap
