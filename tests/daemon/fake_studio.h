// Cameras that do what a test says.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/errors.h"
#include "drivers/studio.h"

namespace mocap::testing {

inline constexpr int kFakeWidth = 64;
inline constexpr int kFakeHeight = 48;
inline constexpr std::int64_t kFakePeriodNs = 40'000'000;

/// What Grab gives in its n-th call; for a frame, when it was captured.
struct FakeGrab {
  GrabStatus status = GrabStatus::kEnd;
  std::int64_t capture_ns = 0;
};
using FakeScript = std::function<FakeGrab(int call)>;

/// Frames of a steady camera, then the end.
inline FakeScript SteadyFrames(int frames) {
  return [frames](int call) {
    return call < frames ? FakeGrab{GrabStatus::kFrame, call * kFakePeriodNs} : FakeGrab{};
  };
}

/// A grey room with a little grain that never moves.
inline Image<Bgr> FakeRoom(int grain) {
  Image<Bgr> image(kFakeWidth, kFakeHeight);
  std::uint32_t state = 12345u + static_cast<std::uint32_t>(grain);
  for (Bgr& pixel : image.pixels()) {
    state = state * 1664525u + 1013904223u;
    const auto value = static_cast<std::uint8_t>(120 + (state >> 29));
    pixel = {value, value, value};
  }
  return image;
}

class FakeDriver : public CameraDriver {
 public:
  explicit FakeDriver(FakeScript script) : script_(std::move(script)), picture_(FakeRoom(99)) {}

  void Start() override {
    if (!script_) throw SetupError("fake camera: is not there");
  }
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    const FakeGrab grab = script_(calls_++);
    if (grab.status == GrabStatus::kFrame) {
      frame.image = std::as_const(picture_).view();
      frame.capture_ns = grab.capture_ns;
      frame.sequence = sequence_++;
      frame.angles = {};
    }
    return grab.status;
  }
  void Stop() override {}
  CameraFacts Facts() const override {
    CameraFacts facts;
    facts.remarks = {"is fake"};
    return facts;
  }

 private:
  FakeScript script_;
  Image<Bgr> picture_;
  int calls_ = 0;
  std::uint64_t sequence_ = 0;
};

/// A ring of cameras that look at the middle of the room, one for each script.
inline Studio FakeStudio(const std::vector<FakeScript>& scripts) {
  Studio studio;
  studio.name = "fake";
  studio.fps_nominal = 25;
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    StudioCamera& camera = studio.cameras.emplace_back();
    camera.calibration.name = "cam" + std::to_string(i + 1);
    camera.calibration.width_px = kFakeWidth;
    camera.calibration.height_px = kFakeHeight;
    OpenCvLens lens;
    lens.K << 60, 0, kFakeWidth / 2, 0, 60, kFakeHeight / 2, 0, 0, 1;
    camera.calibration.lens = lens;
    const double angle = 2 * 3.14159 * static_cast<double>(i) / static_cast<double>(scripts.size());
    const Vector3 forward_W(-std::cos(angle), -std::sin(angle), 0);
    camera.calibration.X_CW.R.row(0) = Vector3(forward_W.y(), -forward_W.x(), 0);
    camera.calibration.X_CW.R.row(1) = -Vector3::UnitZ();
    camera.calibration.X_CW.R.row(2) = forward_W;
    camera.calibration.X_CW.p =
        -(camera.calibration.X_CW.R * (Vector3(0, 0, 1000) - 4000 * forward_W));
    camera.driver = std::make_unique<FakeDriver>(scripts[i]);
    camera.background = [] {
      std::vector<BackgroundFrame> frames;
      for (int grain = 0; grain < 12; ++grain) frames.push_back({FakeRoom(grain), {}});
      return frames;
    };
  }
  return studio;
}

}  // namespace mocap::testing
