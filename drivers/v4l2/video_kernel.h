// The kernel calls that V4L2 needs, as an interface that tests can replace.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace mocap {

/// Negative results are errors: -errno. Thread-safe.
class VideoKernel {
 public:
  virtual ~VideoKernel() = default;
  /// Opens a device without blocking. @return  its handle.
  virtual int Open(const std::string& node) = 0;
  virtual void Close(int handle) = 0;
  /// ioctl, repeated when interrupted by a signal.
  virtual int Request(int handle, unsigned long request, void* argument) = 0;
  /// Null on failure.
  virtual void* Map(int handle, std::size_t length, std::int64_t offset) = 0;
  virtual void Unmap(void* memory, std::size_t length) = 0;
  /// Waits for data or an error. @return  0 on timeout.
  virtual int Wait(int handle, std::chrono::milliseconds timeout) = 0;
};

/// The real kernel.
std::shared_ptr<VideoKernel> SystemVideoKernel();

}  // namespace mocap
