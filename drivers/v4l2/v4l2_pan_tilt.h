// A pan-tilt head controlled through its V4L2 camera.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "drivers/polled_pan_tilt.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Reads and sets pan and tilt while the camera streams. (USB requests would need the kernel's
/// driver to be detached, which ends the stream.)
class V4l2PanTilt : public PolledPanTilt {
 public:
  /// @param device  the camera's name.
  /// @param delay   lag of a reading behind the head.
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
