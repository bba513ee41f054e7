// Cameras whose clocks agree in nothing, and yet their frames find each other.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "daemon/pipeline/synchronizer.h"
#include "drivers/aravis/aravis_driver.h"
#include "tests/support/pattern_camera.h"
#include "tests/support/private_network.h"
#include "tools/gige/gige_camera.h"
#include "tools/gige/loopback.h"

namespace mocap {
namespace {

using std::chrono::milliseconds;

constexpr int kWidth_px = 64, kHeight_px = 48;
constexpr double kFps = 25;
constexpr std::int64_t kCameraPeriod_ns = 40'000'000;
constexpr std::int64_t kMinute_ns = 60'000'000'000;
constexpr int kCameras = 4, kHalfRateCamera = 3;
/// After so many, clocks are known, whatever this machine did to single frames.
constexpr int kFramesToSettle = 40;
constexpr int kSets = 50;
constexpr double kPatience_periods = 25;

/// Served cameras, and the drivers that take their frames.
class WrongClocks {
 public:
  WrongClocks() {
    const std::array<GigeFaults, kCameras> faults = {
        {{.clock_offset_ns = -7 * kMinute_ns, .clock_drift_ppm = 50, .jitter_ms = 5, .seed = 1},
         {.clock_offset_ns = 3 * kMinute_ns, .clock_drift_ppm = -50, .jitter_ms = 5, .seed = 2},
         {.clock_offset_ns = 0, .clock_drift_ppm = 20, .jitter_ms = 5, .seed = 3},
         {.clock_offset_ns = kMinute_ns, .clock_drift_ppm = 0, .jitter_ms = 5, .seed = 4}}};
    for (int i = 0; i < kCameras; ++i) {
      const std::string ip = AddressAfter("127.0.1.1", i);
      EnsureLoopbackAddress(ip);
      served_.push_back(std::make_unique<GigeCamera>(
          GigeIdentity{ip, "cam", ip, false},
          std::make_unique<testing::PatternCamera>(kWidth_px, kHeight_px, kFps), faults[i]));
      AravisSettings settings;
      settings.format = "BGR8";
      settings.packet_bytes = 9000;
      const double fps = i == kHalfRateCamera ? kFps / 2 : kFps;
      drivers_.push_back(
          std::make_unique<AravisDriver>(CameraRequest{ip, kWidth_px, kHeight_px, fps}, settings));
      drivers_.back()->Start();
    }
  }

  /// Waits a moment for a frame of a camera whose clock is known by now.
  bool Grab(int camera, Frame& frame) {
    if (drivers_[camera]->Grab(frame, milliseconds(2)) != GrabStatus::kFrame) return false;
    const int settled = camera == kHalfRateCamera ? kFramesToSettle / 2 : kFramesToSettle;
    return ++frames_[camera] > settled;
  }

 private:
  std::vector<std::unique_ptr<GigeCamera>> served_;
  std::vector<std::unique_ptr<AravisDriver>> drivers_;
  std::array<int, kCameras> frames_{};
};

TEST(CameraClocks, SetsAreRightWhateverTheClocksSay) {
  const std::string reason = testing::EnterPrivateNetwork();
  if (!reason.empty()) GTEST_SKIP() << reason;
  WrongClocks cameras;
  Synchronizer synchronizer(kCameras, kCameraPeriod_ns, kPatience_periods);
  std::array<int, kCameras> members{}, shown{};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  for (int sets = 0; sets < kSets && std::chrono::steady_clock::now() < deadline;) {
    for (int i = 0; i < kCameras; ++i) {
      Frame frame;
      if (synchronizer.has_front(i) || !cameras.Grab(i, frame)) continue;
      synchronizer.NoteNewest(frame.capture_ns);
      if (synchronizer.Offer(i, frame.capture_ns, frame.sequence)) shown[i] = frame.image(0, 0).g;
    }
    Synchronizer::Decision decision;
    while ((decision = synchronizer.Decide()) != Synchronizer::Decision::kWait) {
      if (decision != Synchronizer::Decision::kSet) continue;
      ++sets;
      int picture = -1;
      for (int i = 0; i < kCameras; ++i) {
        if (!synchronizer.members()[i]) continue;
        ++members[i];
        if (picture < 0) picture = shown[i];
        EXPECT_EQ(shown[i], picture) << "camera " << i << " in set " << sets;
      }
    }
  }
  EXPECT_GT(members[0], kSets / 2);
  EXPECT_GT(members[kHalfRateCamera], kSets / 8);
}

}  // namespace
}  // namespace mocap
