#include "daemon/nodes/silhouette_sender.h"

#include <filesystem>
#include <random>

#include "daemon/nodes/host_clock_care.h"
#include "daemon/nodes/picture_packing.h"
#include "drivers/clock.h"
#include "drivers/take/calibration_file.h"

namespace mocap {
namespace {

constexpr double kNodeHz = 2;

std::int64_t NewSession() {
  std::random_device random;
  return static_cast<std::int64_t>(random()) << 31 ^ random();
}

}  // namespace

SilhouetteSender::SilhouetteSender(LcmSender& sender, const Config& config,
                                   std::span<const CameraCalibration> cameras)
    : sender_(sender),
      silhouette_channel_(config.lcm.prefix + "MOCAP_SILHOUETTE"),
      node_channel_(config.lcm.prefix + "MOCAP_NODE"),
      node_pacer_(kNodeHz) {
  node_.name = config.node.name;
  node_.session = NewSession();
  node_.version = MOCAP_VERSION;
  node_.host = BootName();
  for (const CameraCalibration& camera : cameras) {
    silhouette_t& message = messages_.emplace_back();
    message.node = node_.name;
    message.session = node_.session;
    message.number = 0;
    message.camera = camera.name;
    message.width_px = camera.width_px;
    message.height_px = camera.height_px;
    node_.cameras.push_back({camera.name, "", CalibrationText("", std::span(&camera, 1))});
  }
  node_.num_cameras = static_cast<std::int32_t>(node_.cameras.size());
}

void SilhouetteSender::OnSilhouette(int camera, const SegmentedFrame& frame) {
  silhouette_t& message = messages_[static_cast<std::size_t>(camera)];
  message.clock_set_ns = TheHostClock().OffsetNs();
  message.capture_ns = frame.capture_ns + message.clock_set_ns;
  message.sequence = static_cast<std::int64_t>(frame.sequence);
  message.pan_rad = frame.angles.pan_rad;
  message.tilt_rad = frame.angles.tilt_rad;
  message.is_blind = frame.is_blind;
  message.light = frame.light;
  message.nudged_px = frame.nudged_px;
  message.segment_ns = frame.segment_ns;
  PackPicture(frame.trimap, frame.shading, message.packed);
  message.num_bytes = static_cast<std::int32_t>(message.packed.size());
  message.sent_ns = TimelineNs() + message.clock_set_ns;
  sender_.Send(silhouette_channel_, message, bytes_);
  ++message.number;
}

void SilhouetteSender::Tell(const std::vector<CameraStatus>& cameras,
                            const std::vector<std::string>& complaints) {
  if (!node_pacer_.IsDue(SteadyNs())) return;
  const ClockCare care = LookAtClockCare();
  node_.clock_keeper = care.keeper;
  node_.clock_is_kept = care.is_kept;
  node_.clock_error_ms = care.error_ms;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    node_.cameras[i].time_source = cameras[i].time_source;
  node_.complaint = complaints;
  node_.num_complaints = static_cast<std::int32_t>(complaints.size());
  node_.clock_set_ns = TheHostClock().OffsetNs();
  node_.sent_ns = TimelineNs() + node_.clock_set_ns;
  sender_.Send(node_channel_, node_, node_bytes_);
}

}  // namespace mocap
