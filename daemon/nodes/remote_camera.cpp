#include "daemon/nodes/remote_camera.h"

#include "daemon/nodes/picture_packing.h"
#include "drivers/clock.h"

namespace mocap {

SilhouetteSource::Outcome RemoteCamera::Next(const std::atomic<std::int64_t>& wanted_from_ns,
                                             SegmentedFrame& frame) {
  if (expectation() == Expectation::kCertain) {
    expectation_.store(Expectation::kPossible, std::memory_order_release);
  }
  if (!Await()) return Outcome::kNothing;
  const ReceivedSilhouette& received = inbox_.queue.front();
  Count(received.sequence);
  const bool starts_anew =
      newest_ns() > kNoneYetNs && received.capture_ns < newest_ns() - Synchronizer::kClockStepNs;
  if (!starts_anew && received.capture_ns < wanted_from_ns.load(std::memory_order_relaxed)) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    expectation_.store(Expectation::kPossible, std::memory_order_release);
    return Outcome::kNothing;
  }
  expectation_.store(Expectation::kCertain, std::memory_order_release);
  if (!Unpack(frame)) {
    torn_.fetch_add(1, std::memory_order_relaxed);
    expectation_.store(Expectation::kPossible, std::memory_order_release);
    return Outcome::kNothing;
  }
  newest_ns_.store(received.capture_ns, std::memory_order_relaxed);
  return Outcome::kFrame;
}

// Waits for a silhouette, or until the listener has looked round.
bool RemoteCamera::Await() {
  const int seen = inbox_.bell.count();
  if (!inbox_.queue.TryPop()) {
    const bool is_connected = inbox_.is_connected.load(std::memory_order_relaxed);
    if (!is_connected && frames_.load(std::memory_order_relaxed) > 0)
      state_.store(CameraState::kLost, std::memory_order_relaxed);
    expectation_.store(is_connected ? Expectation::kPossible : Expectation::kNone,
                       std::memory_order_release);
    inbox_.bell.WaitPast(seen);
    return inbox_.queue.TryPop();
  }
  return true;
}

bool RemoteCamera::Unpack(SegmentedFrame& frame) {
  const ReceivedSilhouette& received = inbox_.queue.front();
  const CameraCalibration& camera = inbox_.calibration;
  if (!UnpackPicture(received.packed, camera.width_px, camera.height_px, frame.silhouette,
                     frame.shading))
    return false;
  frame.angles = received.angles;
  frame.X_CW = camera.PoseAt(received.angles);
  TraceOutline(camera, frame.X_CW, frame.silhouette, rays_, frame.outline);
  frame.capture_ns = received.capture_ns;
  frame.arrival_ns = received.arrival_ns;
  frame.segment_ns = received.segment_ns;
  frame.sequence = received.sequence;
  frame.is_blind = received.is_blind;
  frame.light = received.light;
  frame.nudged_px = received.nudged_px;
  is_blind_.store(frame.is_blind, std::memory_order_relaxed);
  light_.store(frame.light, std::memory_order_relaxed);
  nudged_px_.store(frame.nudged_px, std::memory_order_relaxed);
  return true;
}

void RemoteCamera::Count(std::uint64_t sequence) {
  state_.store(CameraState::kStreaming, std::memory_order_relaxed);
  const bool is_first = frames_.fetch_add(1, std::memory_order_relaxed) == 0;
  if (!is_first && sequence > next_sequence_) {
    dropped_.fetch_add(static_cast<std::int64_t>(sequence - next_sequence_),
                       std::memory_order_relaxed);
  }
  next_sequence_ = sequence + 1;
}

CameraStatus RemoteCamera::Status() const {
  CameraStatus status;
  status.name = inbox_.calibration.name;
  status.node = inbox_.node;
  status.state = state_.load(std::memory_order_relaxed);
  status.frames = frames_.load(std::memory_order_relaxed);
  status.dropped = dropped_.load(std::memory_order_relaxed) + inbox_.queue.dropped();
  status.torn = torn_.load(std::memory_order_relaxed);
  status.light = light_.load(std::memory_order_relaxed);
  status.nudged_px = nudged_px_.load(std::memory_order_relaxed);
  status.is_blind = is_blind_.load(std::memory_order_relaxed);
  return status;
}

}  // namespace mocap
