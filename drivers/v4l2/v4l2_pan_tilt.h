// A head that is turned by the controls of its V4L2 camera.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "drivers/polled_pan_tilt.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Reads and sets pan and tilt beside the camera's stream. (USB's own requests would need the
/// kernel's driver to let go of the camera, and end the stream.)
class V4l2PanTilt : public PolledPanTilt {
 public:
  /// @param device  the camera's name.
  /// @param delay   by which a reading lags behind the head.
  V4l2PanTilt(std::string device, std::chrono::nanoseconds delay,
              std::shared_ptr<VideoKernel> kernel = SystemVideoKernel(), DeviceTree tree = {});
  ~V4l2PanTilt() override;

 private:
  PanTiltLimits Connect() override;
  void Disconnect() override;
  std::optional<PanTiltAngles> Ask() override;
  bool Send(const PanTiltAngles& angles) override;

  const std::shared_ptr<VideoKernel> kernel_;
  const DeviceTree tree_;
  int handle_ = -1;
};

}  // namespace mocap
