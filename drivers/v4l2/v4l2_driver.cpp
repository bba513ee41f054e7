#include "drivers/v4l2/v4l2_driver.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

/// After this long without a frame, the camera is lost.
constexpr std::chrono::seconds kStall{2};
/// Between attempts to open a lost camera.
constexpr std::chrono::milliseconds kReopenPause{200};

std::string TimeSourceOf(const CaptureTime& time) {
  switch (time.clock) {
    case V4l2Clock::kMonotonic:
      break;
    case V4l2Clock::kGuessed:
      return "timestamps of an unknown clock";
    case V4l2Clock::kArrival:
      return "arrival";
  }
  return time.is_start_of_exposure ? "kernel, start of exposure" : "kernel, end of frame";
}

}  // namespace

V4l2Driver::V4l2Driver(CameraRequest request, V4l2Settings settings,
                       std::shared_ptr<VideoKernel> kernel, DeviceTree tree)
    : request_(std::move(request)),
      settings_(std::move(settings)),
      kernel_(std::move(kernel)),
      tree_(std::move(tree)) {}

V4l2Driver::~V4l2Driver() { Stop(); }

void V4l2Driver::Start() {
  MOCAP_CHECK(!started_);
  node_ = FindV4l2Node(*kernel_, request_.device, tree_);
  Connect();
  started_ = true;
}

void V4l2Driver::Stop() {
  stream_.reset();
  started_ = false;
}

void V4l2Driver::Connect() {
  stream_ = std::make_unique<V4l2Stream>(kernel_, node_, request_, settings_);
  is_broken_ = false;
  trouble_.clear();
  kernel_sequence_.reset();
  last_sign_ = Steady::now();
}

GrabStatus V4l2Driver::Grab(Frame& frame, std::chrono::milliseconds timeout) {
  MOCAP_CHECK(started_);
  if (!stream_) return TryToReturn(timeout);
  if (is_broken_) return Lose("accepts no buffers any more");
  V4l2Buffer buffer;
  switch (stream_->Wait(timeout, buffer)) {
    case V4l2Wait::kNothing:
      return Steady::now() - last_sign_ > kStall ? Lose("delivers nothing") : GrabStatus::kTimeout;
    case V4l2Wait::kBroken:
      return Lose("stopped streaming");
    case V4l2Wait::kBuffer:
      break;
  }
  last_sign_ = Steady::now();
  const GrabStatus status = Take(buffer, frame);
  // The frame is good, even if no more will come.
  is_broken_ = !stream_->GiveBack(buffer);
  return status;
}

GrabStatus V4l2Driver::Take(const V4l2Buffer& buffer, Frame& frame) {
  const std::uint64_t sequence = Count(buffer.sequence);
  const V4l2Format& format = stream_->format();
  const RawPicture picture{format.pixels, format.width_px, format.height_px, format.stride_bytes,
                           buffer.bytes};
  if ((buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || !converter_.Convert(picture, image_)) {
    return GrabStatus::kTorn;
  }
  time_ = CaptureTimeOf(buffer.stamp_ns, buffer.flags, stream_->exposure_ns(), TheHostClock());
  bytes_per_frame_ = static_cast<double>(buffer.bytes.size());
  frame.image = std::as_const(image_).view();
  frame.capture_ns = time_.capture_ns;
  frame.sequence = sequence;
  return GrabStatus::kFrame;
}

std::uint64_t V4l2Driver::Count(std::uint32_t sequence) {
  // The kernel's 32-bit count restarts with each stream, and is constant for some drivers.
  const std::uint32_t step = kernel_sequence_ ? sequence - *kernel_sequence_ : 1;
  kernel_sequence_ = sequence;
  return sequence_ += std::max(step, 1u);
}

GrabStatus V4l2Driver::Lose(const std::string& why) {
  stream_.reset();
  trouble_ = why;
  last_sign_ = Steady::now();
  return GrabStatus::kLost;
}

GrabStatus V4l2Driver::TryToReturn(std::chrono::milliseconds timeout) {
  const auto due = last_sign_ + kReopenPause;
  if (Steady::now() < due) {
    std::this_thread::sleep_until(std::min(due, Steady::now() + timeout));
    return GrabStatus::kLost;
  }
  last_sign_ = Steady::now();
  try {
    const V4l2Node found = FindV4l2Node(*kernel_, request_.device, tree_);
    if (found.identity() != node_.identity()) {
      throw SetupError(request_.device + ": is now a different camera, " + found.identity());
    }
    node_ = found;
    Connect();
    return GrabStatus::kTimeout;
  } catch (const SetupError& error) {
    trouble_ = error.what();
    return GrabStatus::kLost;
  }
}

CameraFacts V4l2Driver::Facts() const {
  CameraFacts facts;
  facts.device = node_.path;
  facts.bus = node_.controller();
  facts.link_mbit_s = node_.link_mbit_s;
  facts.bytes_per_frame = bytes_per_frame_;
  if (stream_) {
    facts.format = stream_->format().name;
    facts.fps = stream_->format().fps;
    facts.time_source = TimeSourceOf(time_);
    facts.remarks = stream_->remarks();
  }
  if (!trouble_.empty()) facts.remarks.push_back(trouble_);
  if (time_.clock == V4l2Clock::kArrival && bytes_per_frame_ > 0) {
    facts.remarks.push_back(
        "its timestamps match no clock, so frames get their time of arrival; expect some "
        "milliseconds of jitter");
  }
  return facts;
}

}  // namespace mocap
