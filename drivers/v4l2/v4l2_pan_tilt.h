// A head that is turned by the controls of its V4L2 camera.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "drivers/angle_track.h"
#include "drivers/pan_tilt.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Reads and sets pan and tilt beside the camera's stream. (USB's own requests would need the
/// kernel's driver to let go of the camera, and end the stream.)
class V4l2PanTilt : public PanTilt {
 public:
  /// @param device  the camera's name.
  /// @param delay   by which a reading lags behind the head.
  V4l2PanTilt(std::string device, std::chrono::nanoseconds delay,
              std::shared_ptr<VideoKernel> kernel = SystemVideoKernel(), DeviceTree tree = {});
  ~V4l2PanTilt() override;

  void Start() override;
  void Stop() override;
  /// Comes back by itself when its camera does.
  void Update() override;
  PanTiltAngles At(std::int64_t capture_ns) const override { return track_.At(capture_ns); }
  bool TurnTo(const PanTiltAngles& angles) override;
  PanTiltLimits limits() const override { return limits_; }

 private:
  using Steady = std::chrono::steady_clock;

  void Connect();
  bool Read();

  const std::string device_;
  const std::chrono::nanoseconds delay_;
  const std::shared_ptr<VideoKernel> kernel_;
  const DeviceTree tree_;
  int handle_ = -1;
  Steady::time_point last_attempt_;
  PanTiltLimits limits_;
  AngleTrack track_;
};

}  // namespace mocap
