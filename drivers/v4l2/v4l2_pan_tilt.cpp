#include "drivers/v4l2/v4l2_pan_tilt.h"

#include <linux/videodev2.h>

#include <cmath>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

std::optional<double> Get(VideoKernel& kernel, int handle, std::uint32_t id) {
  v4l2_control control{};
  control.id = id;
  if (kernel.Request(handle, VIDIOC_G_CTRL, &control) < 0) return std::nullopt;
  return control.value * kArcSecond_rad;
}

bool Set(VideoKernel& kernel, int handle, std::uint32_t id, double angle_rad) {
  v4l2_control control{};
  control.id = id;
  control.value = static_cast<int>(std::lround(angle_rad / kArcSecond_rad));
  return kernel.Request(handle, VIDIOC_S_CTRL, &control) >= 0;
}

/// @return  false when there is no such control.
bool Range(VideoKernel& kernel, int handle, std::uint32_t id, double& least_rad, double& most_rad) {
  v4l2_queryctrl query{};
  query.id = id;
  if (kernel.Request(handle, VIDIOC_QUERYCTRL, &query) < 0) return false;
  least_rad = query.minimum * kArcSecond_rad;
  most_rad = query.maximum * kArcSecond_rad;
  return true;
}

}  // namespace

V4l2PanTilt::V4l2PanTilt(std::string device, std::chrono::nanoseconds delay,
                         std::shared_ptr<VideoKernel> kernel, DeviceTree tree)
    : PolledPanTilt(std::move(device), delay), kernel_(std::move(kernel)), tree_(std::move(tree)) {}

V4l2PanTilt::~V4l2PanTilt() { Stop(); }

PanTiltLimits V4l2PanTilt::Connect() {
  const V4l2Node node = FindV4l2Node(*kernel_, device(), tree_);
  handle_ = kernel_->Open(node.path);
  if (handle_ < 0) throw SetupError(node.path + ": the head cannot be opened");
  PanTiltLimits limits;
  PanTiltAngles &least = limits.least, &most = limits.most;
  if (!Range(*kernel_, handle_, V4L2_CID_PAN_ABSOLUTE, least.pan_rad, most.pan_rad) ||
      !Range(*kernel_, handle_, V4L2_CID_TILT_ABSOLUTE, least.tilt_rad, most.tilt_rad)) {
    Disconnect();
    throw SetupError(node.path + ": has no head; its controls lack pan_absolute or tilt_absolute");
  }
  return limits;
}

void V4l2PanTilt::Disconnect() { kernel_->Close(handle_); }

std::optional<PanTiltAngles> V4l2PanTilt::Ask() {
  const auto pan_rad = Get(*kernel_, handle_, V4L2_CID_PAN_ABSOLUTE);
  const auto tilt_rad = Get(*kernel_, handle_, V4L2_CID_TILT_ABSOLUTE);
  if (!pan_rad || !tilt_rad) return std::nullopt;
  return PanTiltAngles{*pan_rad, *tilt_rad};
}

bool V4l2PanTilt::Send(const PanTiltAngles& angles) {
  return Set(*kernel_, handle_, V4L2_CID_PAN_ABSOLUTE, angles.pan_rad) &&
         Set(*kernel_, handle_, V4L2_CID_TILT_ABSOLUTE, angles.tilt_rad);
}

}  // namespace mocap
