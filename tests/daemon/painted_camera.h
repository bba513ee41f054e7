// A camera whose pictures a test paints.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>
#include <utility>

#include "daemon/pipeline/pose_sink.h"
#include "tests/daemon/fake_studio.h"

namespace mocap::testing {

/// A camera in the room of the fake studio. Frames come faster than their times say.
class PaintedCamera : public CameraDriver {
 public:
  /// Changes the picture of the empty room for a frame, counted from 0.
  using Paint = std::function<void(Image<Bgr>& picture, std::int64_t frame)>;

  explicit PaintedCamera(Paint paint) : paint_(std::move(paint)) {}
  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds) override {
    // Otherwise threads of low priority would hardly run.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    picture_ = FakeRoom(99);
    paint_(picture_, frames_);
    frame.image = std::as_const(picture_).view();
    frame.capture_ns = frames_ * kFakePeriodNs;
    frame.sequence = static_cast<std::uint64_t>(frames_++);
    return GrabStatus::kFrame;
  }
  void Stop() override {}

 private:
  const Paint paint_;
  Image<Bgr> picture_;
  std::int64_t frames_ = 0;
};

/// Drops all poses.
class NoPoses : public PoseSink {
  void OnSet(const TrackedSet&) override {}
};

}  // namespace mocap::testing
