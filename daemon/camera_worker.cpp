#include "daemon/camera_worker.h"

#include <limits>
#include <thread>
#include <utility>

#include "daemon/clock.h"

namespace mocap {
namespace {

/// Bounds how long a stop can take.
constexpr std::chrono::milliseconds kGrabTimeout{100};
/// Between attempts to get a lost camera back.
constexpr std::chrono::milliseconds kLostPause{20};
/// More say little that is new.
constexpr int kRaysPerCamera = 100;

}  // namespace

CameraWorker::CameraWorker(StudioCamera camera, Segmenter segmenter, StageRecorders& recorders,
                           FrameTap* tap)
    : camera_(std::move(camera)),
      segmenter_(std::move(segmenter)),
      recorders_(recorders),
      tap_(tap),
      newest_ns_(std::numeric_limits<std::int64_t>::min()) {}

void CameraWorker::Stop() {
  camera_.driver->Stop();
  state_.store(CameraState::kEnded, std::memory_order_relaxed);
}

CameraWorker::Outcome CameraWorker::Next(const std::atomic<std::int64_t>& wanted_from_ns,
                                         SegmentedFrame& out) {
  if (expectation() == Expectation::kCertain) {
    expectation_.store(Expectation::kPossible, std::memory_order_release);
  }
  Frame frame;
  switch (camera_.driver->Grab(frame, kGrabTimeout)) {
    case GrabStatus::kFrame:
      break;
    case GrabStatus::kTimeout:
      return Outcome::kNothing;
    case GrabStatus::kTorn:
      torn_.fetch_add(1, std::memory_order_relaxed);
      return Outcome::kNothing;
    case GrabStatus::kLost:
      Enter(CameraState::kLost);
      expectation_.store(Expectation::kNone, std::memory_order_release);
      std::this_thread::sleep_for(kLostPause);
      return Outcome::kNothing;
    case GrabStatus::kEnd:
      return Outcome::kEnd;
  }
  CountFrame(frame.sequence);
  if (tap_) tap_->Offer([&frame](TappedFrame& copy) { return CopyFrame(frame, copy); });
  if (frame.capture_ns < wanted_from_ns.load(std::memory_order_relaxed)) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    expectation_.store(Expectation::kPossible, std::memory_order_release);
    return Outcome::kNothing;
  }
  expectation_.store(Expectation::kCertain, std::memory_order_release);
  out.arrival_ns = EpochNs();
  out.capture_ns = frame.capture_ns;
  out.sequence = frame.sequence;
  out.X_CW = camera_.calibration.PoseAt(frame.angles);
  const std::int64_t begin_ns = SteadyNs();
  segmenter_.Segment(frame.image, frame.angles, out.silhouette);
  TraceOutline(camera_.calibration, out.X_CW, out.silhouette, kRaysPerCamera, out.outline);
  out.segment_ns = SteadyNs() - begin_ns;
  recorders_[Stage::kSegment].Record(out.segment_ns);
  newest_ns_.store(frame.capture_ns, std::memory_order_relaxed);
  return Outcome::kFrame;
}

void CameraWorker::Enter(CameraState state) {
  if (state_.exchange(state, std::memory_order_relaxed) == state) return;
  std::vector<std::string> remarks = camera_.driver->Facts().remarks;
  const std::lock_guard lock(remarks_mutex_);
  remarks_ = std::move(remarks);
}

void CameraWorker::CountFrame(std::uint64_t sequence) {
  Enter(CameraState::kStreaming);
  // The first frame's number means nothing, and a camera that came back counts from anew.
  const bool is_first = frames_.fetch_add(1, std::memory_order_relaxed) == 0;
  if (!is_first && sequence > next_sequence_) {
    const auto gap = static_cast<std::int64_t>(sequence - next_sequence_);
    dropped_.fetch_add(gap, std::memory_order_relaxed);
  }
  next_sequence_ = sequence + 1;
}

CameraStatus CameraWorker::Status() const {
  CameraStatus status;
  status.name = camera_.calibration.name;
  status.state = state_.load(std::memory_order_relaxed);
  status.frames = frames_.load(std::memory_order_relaxed);
  status.dropped = dropped_.load(std::memory_order_relaxed);
  status.torn = torn_.load(std::memory_order_relaxed);
  const std::lock_guard lock(remarks_mutex_);
  status.remarks = remarks_;
  return status;
}

}  // namespace mocap
