#include "drivers/v4l2/v4l2_pan_tilt.h"

#include <linux/videodev2.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/errors.h"
#include "drivers/v4l2/v4l2_time.h"

namespace mocap {
namespace {

/// V4L2 counts in seconds of arc.
constexpr double kUnit_rad = std::numbers::pi / (180 * 3600);
constexpr std::chrono::milliseconds kRetryPause{500};

std::optional<double> Get(VideoKernel& kernel, int handle, std::uint32_t id) {
  v4l2_control control{};
  control.id = id;
  if (kernel.Request(handle, VIDIOC_G_CTRL, &control) < 0) return std::nullopt;
  return control.value * kUnit_rad;
}

bool Set(VideoKernel& kernel, int handle, std::uint32_t id, double angle_rad) {
  v4l2_control control{};
  control.id = id;
  control.value = static_cast<int>(std::lround(angle_rad / kUnit_rad));
  return kernel.Request(handle, VIDIOC_S_CTRL, &control) >= 0;
}

/// @return  false when there is no such control.
bool Range(VideoKernel& kernel, int handle, std::uint32_t id, double& least_rad, double& most_rad) {
  v4l2_queryctrl query{};
  query.id = id;
  if (kernel.Request(handle, VIDIOC_QUERYCTRL, &query) < 0) return false;
  least_rad = query.minimum * kUnit_rad;
  most_rad = query.maximum * kUnit_rad;
  return true;
}

}  // namespace

V4l2PanTilt::V4l2PanTilt(std::string device, std::chrono::nanoseconds delay,
                         std::shared_ptr<VideoKernel> kernel, DeviceTree tree)
    : device_(std::move(device)),
      delay_(delay),
      kernel_(std::move(kernel)),
      tree_(std::move(tree)) {}

V4l2PanTilt::~V4l2PanTilt() { Stop(); }

void V4l2PanTilt::Start() {
  Connect();
  if (!Read()) throw SetupError(device_ + ": does not tell where its head points");
}

void V4l2PanTilt::Stop() {
  if (handle_ >= 0) kernel_->Close(handle_);
  handle_ = -1;
}

void V4l2PanTilt::Connect() {
  last_attempt_ = Steady::now();
  const V4l2Node node = FindV4l2Node(*kernel_, device_, tree_);
  handle_ = kernel_->Open(node.path);
  if (handle_ < 0) throw SetupError(node.path + ": cannot be opened for its head");
  PanTiltAngles &least = limits_.least, &most = limits_.most;
  if (!Range(*kernel_, handle_, V4L2_CID_PAN_ABSOLUTE, least.pan_rad, most.pan_rad) ||
      !Range(*kernel_, handle_, V4L2_CID_TILT_ABSOLUTE, least.tilt_rad, most.tilt_rad)) {
    Stop();
    throw SetupError(node.path + ": has no head; its controls lack pan_absolute or tilt_absolute");
  }
}

bool V4l2PanTilt::Read() {
  const std::int64_t before_ns = ReadClocks().epoch_ns;
  const auto pan_rad = Get(*kernel_, handle_, V4L2_CID_PAN_ABSOLUTE);
  const auto tilt_rad = Get(*kernel_, handle_, V4L2_CID_TILT_ABSOLUTE);
  if (!pan_rad || !tilt_rad) return false;
  const std::int64_t middle_ns = (before_ns + ReadClocks().epoch_ns) / 2;
  track_.Add(middle_ns - delay_.count(), {*pan_rad, *tilt_rad});
  return true;
}

void V4l2PanTilt::Update() {
  if (handle_ >= 0 && !Read()) Stop();
  if (handle_ >= 0 || Steady::now() - last_attempt_ < kRetryPause) return;
  try {
    Connect();
  } catch (const SetupError&) {
    // Its camera is lost as well, which is told there.
  }
}

bool V4l2PanTilt::TurnTo(const PanTiltAngles& angles) {
  if (handle_ < 0 || !limits_.Contain(angles)) return false;
  return Set(*kernel_, handle_, V4L2_CID_PAN_ABSOLUTE, angles.pan_rad) &&
         Set(*kernel_, handle_, V4L2_CID_TILT_ABSOLUTE, angles.tilt_rad);
}

}  // namespace mocap
