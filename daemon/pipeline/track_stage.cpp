#include "daemon/pipeline/track_stage.h"

#include <memory>
#include <utility>

#include "drivers/clock.h"

namespace mocap {
namespace {

/// Of the box around the body: what a camera has to look at to see all of it.
std::optional<Vector3> MiddleOf(const CaptureResult& result) {
  const bool is_known =
      result.state == CaptureState::kTracking || result.state == CaptureState::kAcquiring;
  if (!is_known) return std::nullopt;
  return (result.points_W.rowwise().minCoeff() + result.points_W.rowwise().maxCoeff()) / 2;
}

}  // namespace

TrackStage::TrackStage(std::unique_ptr<MotionCapture> capture, LatencyOrigin origin, PoseSink& sink,
                       StageRecorders& recorders, std::shared_ptr<SubjectPosition> person)
    : capture_(std::move(capture)),
      origin_(origin),
      sink_(sink),
      recorders_(recorders),
      person_(std::move(person)) {}

TrackStage::~TrackStage() { delete next_subject_.load(); }

void TrackStage::ChangeSubject(const std::optional<BodySizes>& sizes) {
  delete next_subject_.exchange(new Subject(sizes));
}

void TrackStage::Process(const CarvedSet& set) {
  if (next_subject_.load(std::memory_order_relaxed)) {
    const std::unique_ptr<const Subject> subject(next_subject_.exchange(nullptr));
    *subject ? capture_->Expect(**subject) : capture_->Forget();
  }
  stage_ns_ = {};
  const std::int64_t begin_ns = mark_ns_ = SteadyNs();
  const CaptureResult& result =
      capture_->Update(set.grid, set.outlines, Onward(set.capture_ns), this);
  const std::int64_t update_ns = SteadyNs() - begin_ns;
  recorders_[Stage::kLabel].Record(stage_ns_[0]);
  recorders_[Stage::kFilter].Record(stage_ns_[1]);
  recorders_[Stage::kTotal].Record(set.work_ns + update_ns);
  state_.store(result.state, std::memory_order_relaxed);
  if (person_) person_->Tell(MiddleOf(result));
  const std::int64_t publish_ns = SteadyNs();
  sink_.OnSet({.frame = set.frame,
               .capture_ns = set.capture_ns,
               .complete_ns = set.complete_ns,
               .cameras = set.cameras,
               .acquisition_frames = capture_->acquisition_frames(),
               .result = result,
               .body = capture_->body(),
               .grid = set.grid});
  recorders_[Stage::kPublish].Record(SteadyNs() - publish_ns);
  const std::int64_t from_ns =
      origin_ == LatencyOrigin::kCapture ? set.capture_ns : set.complete_ns;
  recorders_[Stage::kLatency].Record(TimelineNs() - from_ns);
  sets_.fetch_add(1, std::memory_order_relaxed);
}

// A clock that is put back does not take the person back.
std::int64_t TrackStage::Onward(std::int64_t capture_ns) {
  if (last_ns_ && capture_ns + shift_ns_ < *last_ns_) shift_ns_ = *last_ns_ - capture_ns;
  last_ns_ = capture_ns + shift_ns_;
  return *last_ns_;
}

void TrackStage::OnStageEnd(UpdateStage stage) {
  const std::int64_t now_ns = SteadyNs();
  stage_ns_[static_cast<std::size_t>(stage)] += now_ns - mark_ns_;
  mark_ns_ = now_ns;
}

}  // namespace mocap
