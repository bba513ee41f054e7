#include "tests/support/fake_video_kernel.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "drivers/v4l2/v4l2_time.h"

namespace mocap::testing {
namespace {

std::size_t BytesOf(const FakeCamera& camera) {
  const auto pixels = static_cast<std::size_t>(camera.width) * camera.height;
  return camera.fourcc == static_cast<int>(V4L2_PIX_FMT_GREY) ? pixels : 2 * pixels;
}

template <std::size_t kSize>
void Write(unsigned char (&field)[kSize], const std::string& text) {
  std::copy_n(text.begin(), std::min(text.size(), kSize - 1), field);
}

/// The formats without repetition.
std::vector<std::uint32_t> Formats(const FakeCamera& camera) {
  std::vector<std::uint32_t> formats;
  for (const FakeMode& mode : camera.modes) {
    if (std::ranges::find(formats, mode.fourcc) == formats.end()) formats.push_back(mode.fourcc);
  }
  return formats;
}

const FakeMode* Nearest(const FakeCamera& camera, const v4l2_pix_format& wanted) {
  const FakeMode* nearest = &camera.modes.front();
  for (const FakeMode& mode : camera.modes) {
    if (mode.fourcc != wanted.pixelformat) continue;
    nearest = &mode;
    if (mode.width == static_cast<int>(wanted.width) &&
        mode.height == static_cast<int>(wanted.height)) {
      break;
    }
  }
  return nearest;
}

int EnumerateFormat(const FakeCamera& camera, v4l2_fmtdesc& format) {
  const std::vector<std::uint32_t> formats = Formats(camera);
  if (format.index >= formats.size()) return -EINVAL;
  format.pixelformat = formats[format.index];
  return 0;
}

int EnumerateSize(const FakeCamera& camera, v4l2_frmsizeenum& size) {
  if (!camera.enumerates) return -ENOTTY;
  std::uint32_t index = 0;
  for (const FakeMode& mode : camera.modes) {
    if (mode.fourcc != size.pixel_format || index++ != size.index) continue;
    size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
    size.discrete = {static_cast<std::uint32_t>(mode.width),
                     static_cast<std::uint32_t>(mode.height)};
    return 0;
  }
  return -EINVAL;
}

int EnumerateRate(const FakeCamera& camera, v4l2_frmivalenum& interval) {
  if (!camera.enumerates) return -ENOTTY;
  for (const FakeMode& mode : camera.modes) {
    if (mode.fourcc != interval.pixel_format || mode.width != static_cast<int>(interval.width) ||
        mode.height != static_cast<int>(interval.height) || interval.index >= mode.rates.size()) {
      continue;
    }
    interval.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    interval.discrete = {1, static_cast<std::uint32_t>(mode.rates[interval.index])};
    return 0;
  }
  return -EINVAL;
}

int SetFormat(FakeCamera& camera, v4l2_format& format) {
  if (camera.format_error != 0) return -camera.format_error;
  v4l2_pix_format& pixels = format.fmt.pix;
  const FakeMode* mode = Nearest(camera, pixels);
  camera.fourcc = static_cast<int>(mode->fourcc);
  camera.width = mode->width;
  camera.height = mode->height;
  pixels.pixelformat = mode->fourcc;
  pixels.width = static_cast<std::uint32_t>(mode->width);
  pixels.height = static_cast<std::uint32_t>(mode->height);
  pixels.bytesperline = camera.told_stride > 0
                            ? camera.told_stride
                            : static_cast<std::uint32_t>(BytesOf(camera)) / pixels.height;
  return 0;
}

int GetFormat(const FakeCamera& camera, v4l2_format& format) {
  const FakeMode& mode = camera.modes.front();
  format.fmt.pix.pixelformat = mode.fourcc;
  format.fmt.pix.width = static_cast<std::uint32_t>(mode.width);
  format.fmt.pix.height = static_cast<std::uint32_t>(mode.height);
  return 0;
}

int Parameters(FakeCamera& camera, bool set, v4l2_streamparm& parameters) {
  v4l2_fract& interval = parameters.parm.capture.timeperframe;
  if (set) {
    const double wanted = 1.0 * interval.denominator / interval.numerator;
    camera.fps = 0;
    for (const FakeMode& mode : camera.modes) {
      if (static_cast<int>(mode.fourcc) != camera.fourcc || mode.width != camera.width) continue;
      for (const int rate : mode.rates) {
        if (camera.fps == 0 || std::abs(rate - wanted) < std::abs(camera.fps - wanted)) {
          camera.fps = rate;
        }
      }
    }
  }
  interval = {1, static_cast<std::uint32_t>(camera.fps)};
  return 0;
}

int GetOrSet(FakeCamera& camera, bool set, v4l2_control& control) {
  const auto found = camera.controls.find(control.id);
  if (found == camera.controls.end()) return -EINVAL;
  FakeControl& own = found->second;
  if (set) own.value = std::clamp(control.value, own.minimum, own.maximum);
  control.value = own.value;
  return 0;
}

int Query(const FakeCamera& camera, v4l2_queryctrl& query) {
  const auto found = camera.controls.find(query.id);
  if (found == camera.controls.end()) return -EINVAL;
  query.minimum = found->second.minimum;
  query.maximum = found->second.maximum;
  return 0;
}

int Describe(const FakeCamera& camera, v4l2_capability& capability) {
  Write(capability.driver, "fake");
  Write(capability.card, camera.card);
  Write(capability.bus_info, camera.bus);
  // The device as a whole can more than this node.
  capability.capabilities =
      V4L2_CAP_DEVICE_CAPS | V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING | V4L2_CAP_META_CAPTURE;
  capability.device_caps = camera.capabilities;
  return 0;
}

}  // namespace

int FakeVideoKernel::Open(const std::string& node) {
  const auto camera = cameras.find(node);
  if (camera == cameras.end() || !camera->second.is_plugged_in) return -ENOENT;
  if (camera->second.open_error != 0) return -camera->second.open_error;
  ++camera->second.opened;
  ++camera->second.handles;
  sessions_[next_handle_].node = node;
  return next_handle_++;
}

void FakeVideoKernel::Close(int handle) {
  FakeCamera& camera = cameras.at(sessions_.at(handle).node);
  --camera.handles;
  if (sessions_.at(handle).streams) camera.streams = false;
  sessions_.erase(handle);
}

void* FakeVideoKernel::Map(int handle, std::size_t length, std::int64_t offset) {
  std::vector<std::uint8_t>& memory = sessions_.at(handle).memory.at(offset);
  memory.resize(length);
  return memory.data();
}

void FakeVideoKernel::Unmap(void*, std::size_t) {}

int FakeVideoKernel::Wait(int handle, std::chrono::milliseconds) {
  Session& session = sessions_.at(handle);
  FakeCamera& camera = cameras.at(session.node);
  if (camera.is_plugged_in && camera.empty_waits > 0) {
    --camera.empty_waits;
    return 0;
  }
  return 1;
}

int FakeVideoKernel::Request(int handle, unsigned long request, void* argument) {
  Session& session = sessions_.at(handle);
  FakeCamera& camera = cameras.at(session.node);
  if (!camera.is_plugged_in) return -ENODEV;
  switch (request) {
    case VIDIOC_QUERYCAP:
      return Describe(camera, *static_cast<v4l2_capability*>(argument));
    case VIDIOC_ENUM_FMT:
      return EnumerateFormat(camera, *static_cast<v4l2_fmtdesc*>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return EnumerateSize(camera, *static_cast<v4l2_frmsizeenum*>(argument));
    case VIDIOC_ENUM_FRAMEINTERVALS:
      return EnumerateRate(camera, *static_cast<v4l2_frmivalenum*>(argument));
    case VIDIOC_S_FMT:
      return SetFormat(camera, *static_cast<v4l2_format*>(argument));
    case VIDIOC_G_FMT:
      return GetFormat(camera, *static_cast<v4l2_format*>(argument));
    case VIDIOC_S_PARM:
    case VIDIOC_G_PARM:
      return Parameters(camera, request == VIDIOC_S_PARM, *static_cast<v4l2_streamparm*>(argument));
    case VIDIOC_S_CTRL:
    case VIDIOC_G_CTRL:
      return GetOrSet(camera, request == VIDIOC_S_CTRL, *static_cast<v4l2_control*>(argument));
    case VIDIOC_QUERYCTRL:
      return Query(camera, *static_cast<v4l2_queryctrl*>(argument));
    default:
      return RequestOpen(session, camera, request, argument);
  }
}

int FakeVideoKernel::RequestOpen(Session& session, FakeCamera& camera, unsigned long request,
                                 void* argument) {
  switch (request) {
    case VIDIOC_REQBUFS:
      if (camera.buffers_error != 0) return -camera.buffers_error;
      session.memory.resize(static_cast<v4l2_requestbuffers*>(argument)->count);
      return 0;
    case VIDIOC_QUERYBUF: {
      auto& buffer = *static_cast<v4l2_buffer*>(argument);
      buffer.length = static_cast<std::uint32_t>(BytesOf(camera));
      buffer.m.offset = buffer.index;
      return 0;
    }
    case VIDIOC_QBUF:
      session.queued.push_back(static_cast<v4l2_buffer*>(argument)->index);
      return 0;
    case VIDIOC_DQBUF:
      return Fill(session, camera, *static_cast<v4l2_buffer*>(argument));
    case VIDIOC_STREAMON:
      if (camera.stream_error != 0) return -camera.stream_error;
      camera.streams = session.streams = true;
      return 0;
    case VIDIOC_STREAMOFF:
      camera.streams = session.streams = false;
      return 0;
    default:
      return -ENOTTY;
  }
}

int FakeVideoKernel::Fill(Session& session, FakeCamera& camera, v4l2_buffer& buffer) {
  if (camera.dequeue_error != 0) return -camera.dequeue_error;
  if (!camera.streams) return -EINVAL;
  if (session.queued.empty()) return -EAGAIN;
  buffer.index = session.queued.front();
  session.queued.pop_front();
  std::vector<std::uint8_t>& memory = session.memory.at(buffer.index);
  for (std::size_t i = 0; i < memory.size(); ++i) {
    memory[i] = static_cast<std::uint8_t>(7 * i + 13 * session.sequence);
  }
  buffer.bytesused = static_cast<std::uint32_t>(memory.size());
  buffer.flags = camera.flags;
  if (camera.short_buffers > 0) --camera.short_buffers, buffer.bytesused /= 2;
  if (camera.error_buffers > 0) --camera.error_buffers, buffer.flags |= V4L2_BUF_FLAG_ERROR;
  if (!camera.skips.empty()) {
    session.sequence += camera.skips.front();
    camera.skips.pop_front();
  }
  buffer.sequence = camera.counts ? session.sequence : 0;
  ++session.sequence;
  const std::int64_t now_us = (ReadClocks().monotonic_ns + camera.stamp_offset_ns) / 1000;
  last_stamp_us_ = std::max(last_stamp_us_ + 1, now_us);
  buffer.timestamp = {last_stamp_us_ / 1'000'000, last_stamp_us_ % 1'000'000};
  return 0;
}

}  // namespace mocap::testing
