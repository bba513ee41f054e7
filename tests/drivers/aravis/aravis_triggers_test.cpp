// What starts exposures, and how the driver of a served camera sees it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "drivers/aravis/gige_action.h"
#include "tests/drivers/aravis/served_camera.h"
#include "tools/gige/gige_description.h"

namespace mocap::testing {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

using AravisTriggersTest = ServedCameraTest;

TEST_F(AravisTriggersTest, SoftwareTriggerKeepsTheRateAskedFor) {
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

TEST_F(AravisTriggersTest, ScheduledExposuresComeAtMultiplesOfThePeriodByPtp) {
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
  // On a busy host a request may come too late, and its exposure then comes when it can.
  constexpr int kInARow = 20;
  int in_a_row = 0;
  const auto last = std::chrono::steady_clock::now() + 10 * kPatience;
  while (in_a_row < kInARow && std::chrono::steady_clock::now() < last) {
    ASSERT_TRUE(GrabFrame(driver, frame));
    // TAI is a whole number of seconds ahead.
    const bool is_multiple = (frame.capture_ns + 1000) % (2 * kPeriod_ns) <= 2000;
    in_a_row = is_multiple ? in_a_row + 1 : 0;
    EXPECT_TRUE(IsOfItsTime(frame));
  }
  EXPECT_EQ(in_a_row, kInARow);
  EXPECT_THAT(driver.Facts().remarks, Not(Contains(HasSubstr("PTP"))));
  EXPECT_THAT(driver.Facts().remarks, Not(Contains(HasSubstr("scheduled"))));
}

TEST_F(AravisTriggersTest, SchedulingNeedsPtpAndSaysWhenThereIsNoMaster) {
  AravisSettings settings = Settings();
  settings.trigger = "ptp";
  const std::string ip = NextAddress(), lonely_ip = NextAddress();
  const auto without = Serve(ip);
  AravisDriver refused(Request(ip), settings);
  EXPECT_EQ(WhyNotStarted(refused), ip + ": trigger \"ptp\" cannot be set; expected a GigE Vision "
                                         "camera that reports its PTP status");
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

TEST_F(AravisTriggersTest, LineTriggerFollowsTheLine) {
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

TEST_F(AravisTriggersTest, StrobeIsAnOutputThatTellsOfTheExposure) {
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

TEST_F(AravisTriggersTest, CameraThatWaitsForItsTriggerIsNotLost) {
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

}  // namespace
}  // namespace mocap::testing
