#include "drivers/aravis/aravis_driver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "drivers/aravis/aravis_directory.h"
#include "tests/drivers/aravis/served_camera.h"
#include "tests/drivers/driver_suite.h"

namespace mocap::testing {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

using AravisDriverTest = ServedCameraTest;

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
  EXPECT_THAT(driver.Facts().remarks, Contains(HasSubstr("exposes for 20 us instead of 20.6")));
  EXPECT_THAT(driver.Facts().remarks, Not(Contains(HasSubstr("gain"))));
  driver.Stop();
  settings.exposure_us = 15'000;
  AravisDriver blurred(Request(ip), settings);
  blurred.Start();
  EXPECT_THAT(blurred.Facts().remarks,
              Contains(HasSubstr("longer than a frame lasts: set exposure_us below ")));
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
  EXPECT_EQ(driver.Facts().time_source, "camera clock, fitted to the host's");
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

INSTANTIATE_TYPED_TEST_SUITE_P(Aravis, CameraDriverSuite, AravisFactory);

}  // namespace
}  // namespace mocap::testing
