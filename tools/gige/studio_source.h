// A recording that starts once all cameras are streaming.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/image.h"
#include "drivers/camera_driver.h"

namespace mocap {

/// State that the cameras of a served studio share; each is a process.
struct StudioStage {
  static constexpr int kMostCameras = 64;
  std::array<std::atomic<bool>, kMostCameras> streams{};
  /// Start of the recording, since the Unix epoch; 0: not every camera streams yet.
  std::atomic<std::int64_t> begin_ns{0};
};

/// Shows the empty studio until every camera has streamed for some seconds, in which the background
/// can be learned. Then the recording starts at the same time for all. A camera that comes later,
/// or again, joins the others.
class StudioSource : public CameraDriver {
 public:
  /// @param recording     begins at the stage's time, once started.
  /// @param is_streaming  tells whether this camera's client has started it.
  StudioSource(StudioStage& stage, int camera, int cameras, double fps, Image<Bgr> empty,
               std::unique_ptr<CameraDriver> recording, std::function<bool()> is_streaming);

  void Start() override {}
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;

 private:
  bool HasBegun();

  StudioStage& stage_;
  const int camera_, cameras_;
  const std::int64_t period_ns_;
  const Image<Bgr> empty_;
  const std::unique_ptr<CameraDriver> recording_;
  const std::function<bool()> is_streaming_;
  bool started_ = false;
  std::uint64_t shown_ = 0;
};

}  // namespace mocap
