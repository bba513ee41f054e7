// The calls of the kernel that V4L2 consists of, so that a test can be the kernel.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace mocap {

/// Numbers below 0 are errors: -errno. Thread-safe.
class VideoKernel {
 public:
  virtual ~VideoKernel() = default;
  /// Opens a device without ever waiting for it. @return  its handle.
  virtual int Open(const std::string& node) = 0;
  virtual void Close(int handle) = 0;
  /// ioctl, begun again when a signal came between.
  virtual int Request(int handle, unsigned long request, void* argument) = 0;
  /// Null when it fails.
  virtual void* Map(int handle, std::size_t length, std::int64_t offset) = 0;
  virtual void Unmap(void* memory, std::size_t length) = 0;
  /// Waits until something can be had, be it an error. @return  0 when nothing came in time.
  virtual int Wait(int handle, std::chrono::milliseconds timeout) = 0;
};

/// The kernel of this machine.
std::shared_ptr<VideoKernel> SystemVideoKernel();

}  // namespace mocap
