#include "daemon/pipeline/camera_worker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::int64_t kNoneYet = std::numeric_limits<std::int64_t>::min();
/// Bounds how long a stop can take.
constexpr std::chrono::milliseconds kGrabTimeout{100};
/// Between attempts to get a lost camera back.
constexpr std::chrono::milliseconds kLostPause{20};
/// A worker comes round ten times a second; one that does not hangs.
constexpr std::chrono::milliseconds kReplacePause{5};
constexpr int kReplacePauses = 400;
constexpr float kLeastGain = 0.01f;
/// Nobody covers more of a camera that can see the whole of a person.
constexpr double kBlindShare = 0.35;
/// Beyond this, pixels are at the end of their range.
constexpr float kMostLightFactor = 2;
/// Contours that lie so far off, where a nudge would have been followed, are those of another view:
/// in pictures of a real studio they lie 0.34 px off at most, of cameras turned by 8 px 0.53 and
/// more.
constexpr float kMostShift_px = 0.5;

}  // namespace

CameraWorker::CameraWorker(StudioCamera camera, Segmenter segmenter, StageRecorders& recorders,
                           std::vector<FrameTap*> taps, PreviewTap* preview, int rays)
    : camera_(std::move(camera)),
      segmenter_(std::move(segmenter)),
      recorders_(recorders),
      taps_(std::move(taps)),
      preview_(preview),
      rays_(rays),
      newest_ns_(kNoneYet) {}

void CameraWorker::Stop() {
  camera_.driver->Stop();
  state_.store(CameraState::kEnded, std::memory_order_relaxed);
}

CameraWorker::Outcome CameraWorker::Next(const std::atomic<std::int64_t>& wanted_from_ns,
                                         SegmentedFrame& out) {
  if (expectation() == Expectation::kCertain) {
    expectation_.store(Expectation::kPossible, std::memory_order_release);
  }
  TakeReplacement();
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
  for (FrameTap* tap : taps_) {
    tap->Offer([&frame](TappedFrame& copy) { return CopyFrame(frame, copy); });
  }
  const bool starts_anew =
      newest_ns() > kNoneYet && frame.capture_ns < newest_ns() - Synchronizer::kClockStepNs;
  if (!starts_anew && frame.capture_ns < wanted_from_ns.load(std::memory_order_relaxed)) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    expectation_.store(Expectation::kPossible, std::memory_order_release);
    return Outcome::kNothing;
  }
  expectation_.store(Expectation::kCertain, std::memory_order_release);
  out.arrival_ns = TimelineNs();
  out.capture_ns = frame.capture_ns;
  out.sequence = frame.sequence;
  out.angles = frame.angles;
  out.X_CW = camera_.calibration.PoseAt(frame.angles);
  const std::int64_t begin_ns = SteadyNs();
  segmenter_.Segment(frame.image, frame.angles, out.silhouette);
  out.shading = segmenter_.shading();
  if (rays_ > 0) TraceOutline(camera_.calibration, out.X_CW, out.silhouette, rays_, out.outline);
  out.segment_ns = SteadyNs() - begin_ns;
  NoteConditions(out);
  recorders_[Stage::kSegment].Record(out.segment_ns);
  newest_ns_.store(frame.capture_ns, std::memory_order_relaxed);
  OfferPreview(frame, out);
  return Outcome::kFrame;
}

void CameraWorker::OfferPreview(const Frame& frame, const SegmentedFrame& segmented) {
  if (!preview_) return;
  preview_->Offer([&](SeenFrame& copy) {
    if (!preview_pacer_.IsDue(SteadyNs()) || !CopyPixels(frame.image, copy.image)) return false;
    copy.silhouette = segmented.silhouette;
    copy.X_CW = segmented.X_CW;
    copy.capture_ns = segmented.capture_ns;
    return true;
  });
}

bool CameraWorker::Replace(Segmenter segmenter) {
  {
    const std::scoped_lock lock(replacement_mutex_);
    replacement_ = std::move(segmenter);
    replacement_waits_.store(true);
  }
  for (int i = 0; replacement_waits_.load() && i < kReplacePauses; ++i) {
    std::this_thread::sleep_for(kReplacePause);
  }
  std::optional<Segmenter> left_over;
  const std::scoped_lock lock(replacement_mutex_);
  std::swap(left_over, replacement_);
  return !replacement_waits_.exchange(false);
}

void CameraWorker::TakeReplacement() {
  if (!replacement_waits_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(replacement_mutex_, std::try_to_lock);
  if (!lock || !replacement_waits_.load()) return;
  std::swap(segmenter_, *replacement_);
  light_.store(1, std::memory_order_relaxed);
  replacements_.fetch_add(1, std::memory_order_relaxed);
  replacement_waits_.store(false);
}

void CameraWorker::NoteConditions(SegmentedFrame& frame) {
  const Conditions& conditions = segmenter_.conditions();
  constexpr int kGreen = 1;
  const float light = 1 / std::max(conditions.gain[kGreen], kLeastGain);
  frame.light = light;
  frame.nudged_px = std::hypot(conditions.displacement.x_px, conditions.displacement.y_px);
  frame.is_blind = frame.silhouette.CoveredShare() > kBlindShare || light > kMostLightFactor ||
                   light < 1 / kMostLightFactor || conditions.shift_px > kMostShift_px;
  is_blind_.store(frame.is_blind, std::memory_order_relaxed);
  light_.store(frame.light, std::memory_order_relaxed);
  nudged_px_.store(frame.nudged_px, std::memory_order_relaxed);
}

void CameraWorker::Enter(CameraState state) {
  if (state_.exchange(state, std::memory_order_relaxed) == state) return;
  const CameraFacts facts = camera_.driver->Facts();
  std::vector<std::string> remarks = facts.remarks;
  if (!facts.damage.empty()) remarks.push_back("frames come damaged: " + facts.damage);
  const std::lock_guard lock(remarks_mutex_);
  remarks_ = std::move(remarks);
  time_source_ = facts.time_source;
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
  status.waits_for = camera_.waits_for;
  status.state = state_.load(std::memory_order_relaxed);
  status.frames = frames_.load(std::memory_order_relaxed);
  status.dropped = dropped_.load(std::memory_order_relaxed);
  status.torn = torn_.load(std::memory_order_relaxed);
  status.replacements = replacements_.load(std::memory_order_relaxed);
  status.light = light_.load(std::memory_order_relaxed);
  status.nudged_px = nudged_px_.load(std::memory_order_relaxed);
  status.is_blind = is_blind_.load(std::memory_order_relaxed);
  const std::lock_guard lock(remarks_mutex_);
  status.remarks = remarks_;
  status.time_source = time_source_;
  return status;
}

}  // namespace mocap
