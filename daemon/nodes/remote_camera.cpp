#include "daemon/nodes/remote_camera.h"

#include "daemon/nodes/picture_packing.h"
#include "drivers/clock.h"

namespace mocap {

SilhouetteSource::Outcome RemoteCamera::Next(const std::atomic<std::int64_t>& wanted_from_ns,
                                             SegmentedFrame& frame) {
  if (expectation() == Expectation::kCertain) counters_.Expect(Expectation::kPossible);
  if (!Await()) return Outcome::kNothing;
  const ReceivedSilhouette& received = inbox_.queue.front();
  counters_.Enter(CameraState::kStreaming);
  counters_.CountFrame(received.sequence);
  if (!counters_.IsWanted(received.capture_ns, wanted_from_ns)) {
    counters_.CountDropped();
    counters_.Expect(Expectation::kPossible);
    return Outcome::kNothing;
  }
  counters_.Expect(Expectation::kCertain);
  if (!Unpack(frame)) {
    counters_.CountTorn();
    counters_.Expect(Expectation::kPossible);
    return Outcome::kNothing;
  }
  counters_.Note(frame);
  return Outcome::kFrame;
}

// Waits for a silhouette, or for the listener's next check.
bool RemoteCamera::Await() {
  const int seen = inbox_.bell.count();
  if (inbox_.queue.TryPop()) return true;
  const bool is_connected = inbox_.is_connected.load(std::memory_order_relaxed);
  if (!is_connected && counters_.has_frames()) counters_.Enter(CameraState::kLost);
  counters_.Expect(is_connected ? Expectation::kPossible : Expectation::kNone);
  inbox_.bell.WaitPast(seen);
  return inbox_.queue.TryPop();
}

bool RemoteCamera::Unpack(SegmentedFrame& frame) {
  const ReceivedSilhouette& received = inbox_.queue.front();
  const CameraCalibration& camera = inbox_.calibration;
  if (!UnpackPicture(received.packed, camera.width_px, camera.height_px, frame.trimap,
                     frame.shading))
    return false;
  frame.angles = received.angles;
  frame.X_CW = camera.PoseAt(received.angles);
  TraceOutline(camera, frame.X_CW, frame.trimap, rays_, frame.outline);
  frame.capture_ns = received.capture_ns;
  frame.arrival_ns = received.arrival_ns;
  frame.segment_ns = received.segment_ns;
  frame.sequence = received.sequence;
  frame.is_blind = received.is_blind;
  frame.light = received.light;
  frame.nudged_px = received.nudged_px;
  return true;
}

CameraStatus RemoteCamera::Status() const {
  CameraStatus status;
  counters_.Fill(status);
  status.name = inbox_.calibration.name;
  status.node = inbox_.node;
  return status;
}

}  // namespace mocap
