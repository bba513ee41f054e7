// A kernel with V4L2 cameras that do what a test tells them.
#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drivers/v4l2/video_kernel.h"

namespace mocap::testing {

/// One format and size that a camera offers, with its rates.
struct FakeMode {
  std::uint32_t fourcc = V4L2_PIX_FMT_YUYV;
  int width = 64, height = 48;
  std::vector<int> rates = {60, 30, 15};
};

struct FakeControl {
  int minimum = 0, maximum = 1, value = 0;
};

/// A camera, and what is to go wrong with it.
struct FakeCamera {
  std::string card = "Fake camera";
  std::string bus = "usb-0000:00:14.0-1";
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::vector<FakeMode> modes = {FakeMode{}};
  bool enumerates = true;  ///< Tells its sizes and rates.
  std::map<std::uint32_t, FakeControl> controls;

  std::uint32_t flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  bool counts = true;             ///< Its sequence goes on.
  std::uint32_t told_stride = 0;  ///< What it says of its rows; 0: the truth.
  std::int64_t stamp_offset_ns = 0;
  std::deque<std::uint32_t> skips;  ///< Frames lost before each of the next ones.
  int error_buffers = 0;            ///< The next buffers carry the error flag.
  int short_buffers = 0;            ///< The next buffers lack bytes.
  int empty_waits = 0;              ///< So often nothing comes.
  int open_error = 0, format_error = 0, buffers_error = 0, stream_error = 0;  ///< errno.
  int dequeue_error = 0;
  bool is_plugged_in = true;

  // What became of it.
  int opened = 0;   ///< How often.
  int handles = 0;  ///< Open now.
  bool streams = false;
  int fourcc = 0, width = 0, height = 0;
  double fps = 0;
};

class FakeVideoKernel : public VideoKernel {
 public:
  /// Cameras by node.
  std::map<std::string, FakeCamera> cameras;

  int Open(const std::string& node) override;
  void Close(int handle) override;
  int Request(int handle, unsigned long request, void* argument) override;
  void* Map(int handle, std::size_t length, std::int64_t offset) override;
  void Unmap(void* memory, std::size_t length) override;
  int Wait(int handle, std::chrono::milliseconds timeout) override;

 private:
  struct Session {
    std::string node;
    std::deque<std::uint32_t> queued;
    std::vector<std::vector<std::uint8_t>> memory;
    std::uint32_t sequence = 0;
    bool streams = false;
  };

  int RequestOpen(Session& session, FakeCamera& camera, unsigned long request, void* argument);
  int Fill(Session& session, FakeCamera& camera, v4l2_buffer& buffer);

  std::map<int, Session> sessions_;
  int next_handle_ = 3;
  std::int64_t last_stamp_us_ = 0;
};

}  // namespace mocap::testing
