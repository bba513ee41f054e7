// A V4L2 camera: webcams, capture cards, whatever Linux shows as /dev/video*.
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
/// Times are the kernel's, moved to the middle of the exposure. A gap in the sequence is what the
/// camera or the kernel lost; it goes on counting when the camera comes back. A camera that is
/// unplugged, fails or delivers nothing for seconds is lost; Grab then tries to open it again a few
/// times a second, under whatever number it has by then, and never takes another camera for it.
class V4l2Driver : public CameraDriver {
 public:
  /// Touches no device yet.
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
  bool is_broken_ = false;              ///< It will deliver no more.
  std::string trouble_;                 ///< Why it is.
  Steady::time_point last_sign_;        ///< Of life, or the last attempt to get it back.
  std::uint64_t sequence_ = 0;
  std::optional<std::uint32_t> kernel_sequence_;
  CaptureTime time_;  ///< Of the last frame.
  double bytes_per_frame_ = 0;
  PixelConverter converter_;
  Image<Bgr> image_;
};

}  // namespace mocap
