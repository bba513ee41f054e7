// An open V4L2 camera that streams into mapped memory.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drivers/camera_request.h"
#include "drivers/v4l2/v4l2_devices.h"
#include "drivers/v4l2/v4l2_format.h"
#include "drivers/v4l2/v4l2_settings.h"
#include "drivers/v4l2/video_kernel.h"

namespace mocap {

/// A filled buffer. The stream owns its bytes until it is given back.
struct V4l2Buffer {
  std::uint32_t index = 0;
  std::uint32_t flags = 0;
  std::uint32_t sequence = 0;
  std::int64_t stamp_ns = 0;  ///< In the clock named by the flags.
  std::span<const std::uint8_t> bytes;
};

/// Result of waiting for a buffer.
enum class V4l2Wait { kBuffer, kNothing, kBroken };

/// Streams from construction to destruction. Thread-bound.
class V4l2Stream {
 public:
  static constexpr int kBuffers = 4;

  /// @throws SetupError  when the camera cannot do what is requested, is in use, or lacks
  /// bandwidth.
  V4l2Stream(std::shared_ptr<VideoKernel> kernel, const V4l2Node& node,
             const CameraRequest& request, const V4l2Settings& settings);
  ~V4l2Stream();
  V4l2Stream(const V4l2Stream&) = delete;
  V4l2Stream& operator=(const V4l2Stream&) = delete;

  const V4l2Format& format() const { return format_; }
  std::int64_t exposure_ns() const { return exposure_ns_; }  ///< 0: unknown.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// Waits for a buffer. kBroken: the stream will deliver nothing more.
  V4l2Wait Wait(std::chrono::milliseconds timeout, V4l2Buffer& buffer);
  /// Returns a buffer to the camera. @return  false when the stream is broken.
  bool GiveBack(const V4l2Buffer& buffer);

 private:
  struct Memory {
    void* start;
    std::size_t length;
  };

  void Open(const V4l2Node& node, const CameraRequest& request, const V4l2Settings& settings);
  void MapBuffers(const std::string& where);
  void Close();

  std::shared_ptr<VideoKernel> kernel_;
  int handle_ = -1;
  V4l2Format format_;
  std::int64_t exposure_ns_ = 0;
  std::vector<std::string> remarks_;
  std::vector<Memory> memory_;
};

}  // namespace mocap
