#include "drivers/v4l2/v4l2_stream.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/errors.h"
#include "drivers/v4l2/v4l2_controls.h"

namespace mocap {
namespace {

v4l2_buffer EmptyBuffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

std::string InUse(const std::string& where) {
  return where + ": is in use by another program; `fuser` shows which";
}

std::string ErrorText(int result) { return std::strerror(-result); }

}  // namespace

V4l2Stream::V4l2Stream(std::shared_ptr<VideoKernel> kernel, const V4l2Node& node,
                       const CameraRequest& request, const V4l2Settings& settings)
    : kernel_(std::move(kernel)) {
  try {
    Open(node, request, settings);
  } catch (...) {
    Close();
    throw;
  }
}

V4l2Stream::~V4l2Stream() { Close(); }

void V4l2Stream::Open(const V4l2Node& node, const CameraRequest& request,
                      const V4l2Settings& settings) {
  const std::string& where = node.path;
  handle_ = kernel_->Open(where);
  if (handle_ < 0) throw SetupError(where + ": cannot be opened: " + ErrorText(handle_));
  format_ = SetFormat(*kernel_, handle_, where, request, settings.format, remarks_);
  MapBuffers(where);
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  const int result = kernel_->Request(handle_, VIDIOC_STREAMON, &type);
  if (result == -ENOSPC) {
    throw SetupError(where + ": the USB bandwidth of " + node.controller() +
                     " is not enough for one more camera with " + format_.name + "; set " +
                     (format_.name == "MJPG" ? "" : "format = \"MJPG\", ") +
                     "a lower fps or smaller size_px, or plug it into another controller");
  }
  if (result == -EBUSY) throw SetupError(InUse(where));
  if (result < 0) throw SetupError(where + ": does not stream: " + ErrorText(result));
  // Some cameras lose their settings when a stream starts.
  exposure_ns_ = SetControls(*kernel_, handle_, settings, remarks_);
}

void V4l2Stream::MapBuffers(const std::string& where) {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  const int result = kernel_->Request(handle_, VIDIOC_REQBUFS, &request);
  if (result == -EBUSY) throw SetupError(InUse(where));
  if (result < 0) throw SetupError(where + ": provides no buffers: " + ErrorText(result));
  for (std::uint32_t index = 0; index < request.count; ++index) {
    v4l2_buffer buffer = EmptyBuffer(index);
    const int found = kernel_->Request(handle_, VIDIOC_QUERYBUF, &buffer);
    void* start = found < 0 ? nullptr : kernel_->Map(handle_, buffer.length, buffer.m.offset);
    if (!start) throw SetupError(where + ": its buffers cannot be mapped");
    memory_.push_back({start, buffer.length});
    const int queued = kernel_->Request(handle_, VIDIOC_QBUF, &buffer);
    if (queued < 0) throw SetupError(where + ": accepts no buffers: " + ErrorText(queued));
  }
}

void V4l2Stream::Close() {
  if (handle_ < 0) return;
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  kernel_->Request(handle_, VIDIOC_STREAMOFF, &type);
  for (const Memory& memory : memory_) kernel_->Unmap(memory.start, memory.length);
  kernel_->Close(handle_);
  handle_ = -1;
}

V4l2Wait V4l2Stream::Wait(std::chrono::milliseconds timeout, V4l2Buffer& out) {
  const int ready = kernel_->Wait(handle_, timeout);
  if (ready == 0) return V4l2Wait::kNothing;
  v4l2_buffer buffer = EmptyBuffer(0);
  const int result = kernel_->Request(handle_, VIDIOC_DQBUF, &buffer);
  if (result == -EAGAIN) return V4l2Wait::kNothing;
  if (result < 0 || buffer.index >= memory_.size()) return V4l2Wait::kBroken;
  const Memory& memory = memory_[buffer.index];
  out.index = buffer.index;
  out.flags = buffer.flags;
  out.sequence = buffer.sequence;
  out.stamp_ns = static_cast<std::int64_t>(buffer.timestamp.tv_sec) * 1'000'000'000 +
                 static_cast<std::int64_t>(buffer.timestamp.tv_usec) * 1000;
  out.bytes = {static_cast<const std::uint8_t*>(memory.start),
               std::min<std::size_t>(buffer.bytesused, memory.length)};
  return V4l2Wait::kBuffer;
}

bool V4l2Stream::GiveBack(const V4l2Buffer& given) {
  v4l2_buffer buffer = EmptyBuffer(given.index);
  return kernel_->Request(handle_, VIDIOC_QBUF, &buffer) >= 0;
}

}  // namespace mocap
