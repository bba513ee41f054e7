#include "drivers/usb/uvc_pan_tilt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>
#include <string>

#include "core/errors.h"
#include "drivers/clock.h"
#include "drivers/usb/uvc_heads.h"
#include "tests/support/mock_usb.h"

namespace mocap::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr int kDegree = 3600;  // Seconds of arc.
constexpr std::chrono::seconds kPatience{20};

/// A computer with a camera on a head at port 2.
class UvcHeadTest : public ::testing::Test {
 protected:
  UvcHeadTest() { usb_.Plug(2, "PT1", camera_); }

  static std::string ErrorFor(const std::string& name) {
    UvcPanTilt head(name, {});
    try {
      head.Start();
    } catch (const SetupError& error) {
      return error.what();
    }
    return "none";
  }

  MockHead camera_, other_;
  MockUsb usb_;
};

TEST_F(UvcHeadTest, TurnsAndTellsWhereItPoints) {
  UvcPanTilt head("PT1", {});
  head.Start();
  EXPECT_NEAR(head.limits().most.pan_rad, 100 * kDegree_rad, 1e-9);
  EXPECT_NEAR(head.limits().least.tilt_rad, -30 * kDegree_rad, 1e-9);
  EXPECT_TRUE(head.TurnTo({20 * kDegree_rad, -10 * kDegree_rad}));
  EXPECT_EQ(camera_.angles(), (MockHead::Angles{20 * kDegree, -10 * kDegree}));
  camera_.Point({-7 * kDegree, 3 * kDegree});
  head.Update();
  const PanTiltAngles now = head.At(TimelineNs());
  EXPECT_NEAR(now.pan_rad, -7 * kDegree_rad, 1e-9);
  EXPECT_NEAR(now.tilt_rad, 3 * kDegree_rad, 1e-9);
}

TEST_F(UvcHeadTest, RefusesDirectionsThatItDoesNotReach) {
  UvcPanTilt head("PT1", {});
  head.Start();
  EXPECT_FALSE(head.TurnTo({101 * kDegree_rad, 0}));
  EXPECT_FALSE(head.TurnTo({0, -31 * kDegree_rad}));
  EXPECT_EQ(camera_.angles(), MockHead::Angles{});
  EXPECT_EQ(OutOfReach({101 * kDegree_rad, 0}, head.limits()),
            "pan 1.763, tilt 0.000 rad is out of range; expected pan -1.745 to 1.745, tilt -0.524 "
            "to 0.524 rad");
}

TEST_F(UvcHeadTest, IsTakenFromTheKernelAndGivenBack) {
  {
    UvcPanTilt head("PT1", {});
    head.Start();
    EXPECT_FALSE(camera_.kernel_has_it());
  }
  EXPECT_TRUE(camera_.kernel_has_it());
}

TEST_F(UvcHeadTest, IsNamedBySerialNumberPortOrBus) {
  for (const char* name : {"PT1", "1-2", "usb-0000:00:14.0-2"}) EXPECT_EQ(ErrorFor(name), "none");
  usb_.Plug(3, "PT1", other_);
  EXPECT_THAT(ErrorFor("PT1"), AllOf(HasSubstr("several"), HasSubstr("usb-0000:00:14.0-2"),
                                     HasSubstr("usb-0000:00:14.0-3")));
  EXPECT_EQ(ErrorFor("1-3"), "none");
}

TEST_F(UvcHeadTest, CameraWithoutOneIsNoHead) {
  usb_.Plug(3, "F1", other_, /*pans=*/false);
  EXPECT_THAT(ErrorFor("F1"), AllOf(HasSubstr("F1: no head"), HasSubstr("(PTZ camera, PT1)")));
}

TEST_F(UvcHeadTest, OneThatDoesNotAnswerIsASetupErrorAndGoesBackToTheKernel) {
  camera_.FallSilent();
  EXPECT_THAT(ErrorFor("PT1"), HasSubstr("usb-0000:00:14.0-2: does not report the range"));
  EXPECT_TRUE(camera_.kernel_has_it());
}

TEST_F(UvcHeadTest, KeepsItsAnglesWhileItIsAwayAndReturnsWithItsSerialNumberAtAnotherPort) {
  UvcPanTilt head("PT1", {});
  head.Start();
  camera_.Point({5 * kDegree, 0});
  head.Update();
  usb_.Unplug(2, camera_);
  UsbBus watch;
  head.Update();
  EXPECT_FALSE(head.TurnTo({}));
  EXPECT_NEAR(head.At(TimelineNs()).pan_rad, 5 * kDegree_rad, 1e-9);
  other_.Point({9 * kDegree, 0});
  usb_.Plug(4, "PT1", other_);
  ASSERT_TRUE(watch.HasChanged(kPatience));
  for (const std::int64_t end_ns = SteadyNs() + std::chrono::nanoseconds(kPatience).count();
       !head.TurnTo({9 * kDegree_rad, 0}) && SteadyNs() < end_ns;) {
    head.Update();
  }
  head.Update();
  EXPECT_NEAR(head.At(TimelineNs()).pan_rad, 9 * kDegree_rad, 1e-9);
}

TEST(UsbBus, TellsWhatIsPluggedInWithItsPortAndSpeed) {
  MockUsb usb;
  MockHead camera;
  usb.Plug(2, "PT1", camera);
  const UsbBus bus;
  const std::vector<UvcHead> heads = FindUvcHeads(bus);
  ASSERT_EQ(heads.size(), 1u);
  const UsbDevice& found = heads[0].usb;
  EXPECT_EQ(found.port, "1-2");
  EXPECT_EQ(found.bus, "usb-0000:00:14.0-2");
  EXPECT_EQ(found.controller(), "usb-0000:00:14.0");
  EXPECT_EQ(found.model, "PTZ camera");
  EXPECT_EQ(found.serial, "PT1");
  EXPECT_EQ(found.link_mbit_s, 480);
  EXPECT_EQ(FindUsbDevice("PT1")->port, "1-2");
  EXPECT_FALSE(FindUsbDevice("PT2"));
}

TEST(UsbBus, TellsOfArrivalsAndDepartures) {
  MockUsb usb;
  UsbBus bus;
  EXPECT_FALSE(bus.HasChanged());
  MockHead camera;
  usb.Plug(2, "PT1", camera);
  EXPECT_TRUE(bus.HasChanged(kPatience));
  EXPECT_EQ(FindUvcHeads(bus).size(), 1u);
  usb.Unplug(2, camera);
  EXPECT_TRUE(bus.HasChanged(kPatience));
  EXPECT_TRUE(FindUvcHeads(bus).empty());
}

}  // namespace
}  // namespace mocap::testing
