// A driver beside a GigE Vision camera that is served in the same process.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/errors.h"
#include "drivers/aravis/aravis_driver.h"
#include "tests/support/pattern_camera.h"
#include "tests/support/private_network.h"
#include "tools/gige/gige_camera.h"
#include "tools/gige/loopback.h"

namespace mocap::testing {

inline constexpr int kWidth_px = 160, kHeight_px = 120;
inline constexpr double kFps = 100;
inline constexpr std::int64_t kPeriod_ns = 10'000'000;
inline constexpr std::chrono::milliseconds kPatience{3000};

/// Threads of other tests in this process would keep it from getting a network of its own.
[[maybe_unused]] inline const bool kNetworkIsEntered = EnterPrivateNetwork().empty();

inline std::string WhyNoNetwork() { return EnterPrivateNetwork(); }

/// Each test's cameras have addresses of their own: sockets of the last one may linger.
inline std::string NextAddress() {
  static int used = 0;
  const std::string ip = AddressAfter("127.0.0.11", used++);
  EXPECT_TRUE(EnsureLoopbackAddress(ip));
  return ip;
}

inline std::unique_ptr<GigeCamera> Serve(const std::string& ip, const GigeFaults& faults = {},
                                         bool has_ptp = false, double fps = kFps) {
  return std::make_unique<GigeCamera>(
      GigeIdentity{ip, "name" + ip.substr(8), "SN" + ip.substr(8), has_ptp},
      std::make_unique<PatternCamera>(kWidth_px, kHeight_px, fps), faults);
}

inline CameraRequest Request(const std::string& device, double fps = kFps) {
  return {device, kWidth_px, kHeight_px, fps};
}

inline AravisSettings Settings(const std::string& format = "BGR8") {
  AravisSettings settings;
  settings.format = format;
  settings.exposure_us = 2000;
  settings.packet_bytes = 9000;
  return settings;
}

class ServedCameraTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = WhyNoNetwork(); !reason.empty()) GTEST_SKIP() << reason;
  }
};

/// Grabs until a frame comes; none in time is a failure.
inline bool GrabFrame(AravisDriver& driver, Frame& frame,
                      std::chrono::milliseconds patience = kPatience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    if (driver.Grab(frame, std::chrono::milliseconds(50)) == GrabStatus::kFrame) return true;
  }
  return false;
}

/// Grabs until something else than a frame is said.
inline GrabStatus GrabUntil(AravisDriver& driver, GrabStatus wanted) {
  Frame frame;
  GrabStatus status = GrabStatus::kFrame;
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (status != wanted && std::chrono::steady_clock::now() < deadline) {
    status = driver.Grab(frame, std::chrono::milliseconds(50));
  }
  return status;
}

/// How far a capture time lies from the multiples of the period at which pictures were taken.
inline std::int64_t OffBeat_ns(std::int64_t capture_ns) {
  const std::int64_t rest = capture_ns % kPeriod_ns;
  return std::min(rest, kPeriod_ns - rest);
}

/// Whether a picture is the one that was taken at its capture time.
inline bool IsOfItsTime(const Frame& frame) {
  const std::int64_t beat = (frame.capture_ns + kPeriod_ns / 2) / kPeriod_ns;
  return frame.image(0, 0).g == PatternCamera::GreyAt(beat);
}

inline std::string WhyNotStarted(AravisDriver& driver) {
  try {
    driver.Start();
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

}  // namespace mocap::testing
