// Driver for V4L2 cameras: webcams, capture cards, all of /dev/video*.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/image.h"
#include "drivers/camera_driver.h"
#include "drivers/camera_request.h"
#include "drivers/pixels/pixel_format.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/v4l2_settings.h"
#include "drivers/v4l2/v4l2_stream.h"
#include "drivers/v4l2/v4l2_time.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// Streams from a V4L2 camera.
///
/// Times are the kernel's, moved to the middle of the exposure. Frames dropped by the camera or the
/// kernel leave a gap in the sequence, which continues when the camera returns. A camera that is
/// unplugged, fails or delivers nothing for seconds is lost. Grab then tries to reopen it a few
/// times a second, under its current number. It never mistakes another camera for it.
class V4l2Driver : public CameraDriver {
 public:
  /// Accesses no device yet.
  V4l2Driver(CameraRequest request, V4l2Settings settings,
             std::shared_ptr<VideoKernel> kernel = SystemVideoKernel(), DeviceTree tree = {});
  ~V4l2Driver() override;

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;
  CameraFacts Facts() const override;

 private:
  using Steady = std::chrono::steady_clock;

  void Connect();
  GrabStatus Lose(const std::string& why);
  GrabStatus TryToReturn(std::chrono::milliseconds timeout);
  GrabStatus Take(const V4l2Buffer& buffer, Frame& frame);
  std::uint64_t Count(std::uint32_t sequence);

  const CameraRequest request_;
  const V4l2Settings settings_;
  const std::shared_ptr<VideoKernel> kernel_;
  const DeviceTree tree_;
  bool started_ = false;
  V4l2Node node_;
  std::unique_ptr<V4l2Stream> stream_;  ///< Null while the camera is lost.
  bool is_broken_ = false;              ///< It will deliver nothing more.
  std::string trouble_;                 ///< The reason.
  Steady::time_point last_sign_;        ///< Last frame, or last attempt to reopen.
  std::uint64_t sequence_ = 0;
  std::optional<std::uint32_t> kernel_sequence_;
  CaptureTime time_;  ///< Of the last frame.
  double bytes_per_frame_ = 0;
  PixelConverter converter_;
  Image<Bgr> image_;
};

}  // namespace mocap
