#include "daemon/pipeline/camera_worker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "drivers/clock.h"

namespace mocap {
namespace {

/// Limits the time that a stop can take.
constexpr std::chrono::milliseconds kGrabTimeout{100};
/// Between attempts to recover a lost camera.
constexpr std::chrono::milliseconds kLostPause{20};
/// A worker turns ten times a second; otherwise it hangs.
constexpr std::chrono::milliseconds kReplacePause{5};
constexpr int kReplacePauses = 400;
constexpr float kLeastGain = 0.01f;
/// A person covers less than this of a camera that can see a whole person.
constexpr double kBlindShare = 0.35;
/// Beyond this factor, pixels saturate.
constexpr float kMostLightFactor = 2;
/// A larger contour shift, where a nudge would have been compensated, means another view. In
/// pictures of a real studio the shift is at most 0.34 px; for cameras turned by 8 px it is at
/// least 0.53 px.
constexpr float kMostShift_px = 0.5;

}  // namespace

CameraWorker::CameraWorker(StudioCamera camera, Segmenter segmenter, StageRecorders& recorders,
                           std::vector<FrameTap*> taps, PreviewTap* preview, int rays)
    : camera_(std::move(camera)),
      segmenter_(std::move(segmenter)),
      recorders_(recorders),
      taps_(std::move(taps)),
      preview_(preview),
      rays_(rays) {}

void CameraWorker::Stop() {
  camera_.driver->Stop();
  counters_.Enter(CameraState::kEnded);
}

CameraWorker::Outcome CameraWorker::Next(const std::atomic<std::int64_t>& wanted_from_ns,
                                         SegmentedFrame& out) {
  if (expectation() == Expectation::kCertain) counters_.Expect(Expectation::kPossible);
  TakeReplacement();
  Frame frame;
  switch (camera_.driver->Grab(frame, kGrabTimeout)) {
    case GrabStatus::kFrame:
      break;
    case GrabStatus::kTimeout:
      return Outcome::kNothing;
    case GrabStatus::kTorn:
      counters_.CountTorn();
      return Outcome::kNothing;
    case GrabStatus::kLost:
      Enter(CameraState::kLost);
      counters_.Expect(Expectation::kNone);
      std::this_thread::sleep_for(kLostPause);
      return Outcome::kNothing;
    case GrabStatus::kEnd:
      return Outcome::kEnd;
  }
  Enter(CameraState::kStreaming);
  counters_.CountFrame(frame.sequence);
  for (FrameTap* tap : taps_) {
    tap->Offer([&frame](TappedFrame& copy) { return CopyFrame(frame, copy); });
  }
  if (!counters_.IsWanted(frame.capture_ns, wanted_from_ns)) {
    counters_.CountDropped();
    counters_.Expect(Expectation::kPossible);
    return Outcome::kNothing;
  }
  counters_.Expect(Expectation::kCertain);
  out.arrival_ns = TimelineNs();
  out.capture_ns = frame.capture_ns;
  out.sequence = frame.sequence;
  out.angles = frame.angles;
  out.X_CW = camera_.calibration.PoseAt(frame.angles);
  const std::int64_t begin_ns = SteadyNs();
  segmenter_.Segment(frame.image, frame.angles, out.trimap);
  out.shading = segmenter_.shading();
  if (rays_ > 0) TraceOutline(camera_.calibration, out.X_CW, out.trimap, rays_, out.outline);
  out.segment_ns = SteadyNs() - begin_ns;
  TellConditions(out);
  recorders_[Stage::kSegment].Record(out.segment_ns);
  counters_.Note(out);
  OfferPreview(frame, out);
  return Outcome::kFrame;
}

void CameraWorker::OfferPreview(const Frame& frame, const SegmentedFrame& segmented) {
  if (!preview_) return;
  preview_->Offer([&](SeenFrame& copy) {
    if (!preview_pacer_.IsDue(SteadyNs()) || !CopyPixels(frame.image, copy.image)) return false;
    copy.trimap = segmented.trimap;
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
  counters_.CountReplacement();
  replacement_waits_.store(false);
}

void CameraWorker::TellConditions(SegmentedFrame& frame) const {
  const Conditions& conditions = segmenter_.conditions();
  constexpr int kGreen = 1;
  const float light = 1 / std::max(conditions.gain[kGreen], kLeastGain);
  frame.light = light;
  frame.nudged_px = std::hypot(conditions.displacement.x_px, conditions.displacement.y_px);
  frame.is_blind = frame.trimap.person.CoveredShare() > kBlindShare || light > kMostLightFactor ||
                   light < 1 / kMostLightFactor || conditions.shift_px > kMostShift_px;
}

void CameraWorker::Enter(CameraState state) {
  if (!counters_.Enter(state)) return;
  const CameraFacts facts = camera_.driver->Facts();
  std::vector<std::string> remarks = facts.remarks;
  if (!facts.damage.empty()) remarks.push_back("frames are damaged: " + facts.damage);
  const std::lock_guard lock(remarks_mutex_);
  remarks_ = std::move(remarks);
  time_source_ = facts.time_source;
}

CameraStatus CameraWorker::Status() const {
  CameraStatus status;
  status.name = camera_.calibration.name;
  status.waits_for = camera_.waits_for;
  counters_.Fill(status);
  const std::lock_guard lock(remarks_mutex_);
  status.remarks = remarks_;
  status.time_source = time_source_;
  return status;
}

}  // namespace mocap
