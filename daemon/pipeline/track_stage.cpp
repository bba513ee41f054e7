#include "daemon/pipeline/track_stage.h"

#include <memory>
#include <utility>

#include "drivers/clock.h"

namespace mocap {
namespace {

/// Extends a box by a body, if its position is known.
void Extend(const CaptureResult& result, Eigen::AlignedBox3d& box_W) {
  const bool is_known =
      result.state == CaptureState::kTracking || result.state == CaptureState::kAcquiring;
  if (!is_known) return;
  box_W.extend(result.points_W.rowwise().minCoeff());
  box_W.extend(result.points_W.rowwise().maxCoeff());
}

/// Center of the box around all people: cameras that look there see as much of them as possible.
std::optional<Vector3> MiddleOf(const PeopleCapture& people) {
  Eigen::AlignedBox3d box_W;
  for (const PersonView& person : people.people()) Extend(person.capture->result(), box_W);
  // A person being measured is not yet among the people.
  if (people.people().empty()) Extend(people.first().result(), box_W);
  return box_W.isEmpty() ? std::nullopt : std::optional<Vector3>(box_W.center());
}

}  // namespace

TrackStage::TrackStage(PeopleCapture people, LatencyOrigin origin, PoseSink& sink,
                       StageRecorders& recorders, std::shared_ptr<SubjectPosition> person)
    : people_(std::move(people)),
      origin_(origin),
      sink_(sink),
      recorders_(recorders),
      person_(std::move(person)) {}

TrackStage::~TrackStage() {
  delete next_subject_.load();
  delete next_known_.load();
  delete next_names_.load();
}

void TrackStage::ChangeSubject(const std::optional<KnownPerson>& subject) {
  delete next_subject_.exchange(new Subject(subject));
}

void TrackStage::KnowPeople(const std::vector<KnownPerson>& people) {
  delete next_known_.exchange(new KnownPeople(people));
}

void TrackStage::NamePerson(int id, const std::string& name) {
  std::unique_ptr<NamedPeople> names(next_names_.exchange(nullptr));
  if (!names) names = std::make_unique<NamedPeople>();
  names->emplace_back(id, name);
  next_names_.store(names.release());
}

void TrackStage::TakeRequests() {
  if (next_subject_.load(std::memory_order_relaxed)) {
    const std::unique_ptr<const Subject> subject(next_subject_.exchange(nullptr));
    *subject ? people_.Expect((*subject)->sizes, (*subject)->name) : people_.Forget();
  }
  if (next_known_.load(std::memory_order_relaxed)) {
    const std::unique_ptr<KnownPeople> known(next_known_.exchange(nullptr));
    people_.Know(std::move(*known));
  }
  if (next_names_.load(std::memory_order_relaxed)) {
    const std::unique_ptr<const NamedPeople> names(next_names_.exchange(nullptr));
    for (const auto& [id, name] : *names) people_.Call(id, name);
  }
}

void TrackStage::Process(const CarvedSet& set, std::span<const KeypointRays> keypoints) {
  TakeRequests();
  stage_ns_ = {};
  const std::int64_t begin_ns = mark_ns_ = SteadyNs();
  Observation room(set.grid, set.outlines, set.person_box_W);
  room.doubtful = set.doubtful;
  room.keypoints = keypoints;
  people_.Update(room, set.eyes, Onward(set.capture_ns), this);
  const MotionCapture& first = people_.first();
  const std::int64_t update_ns = SteadyNs() - begin_ns;
  recorders_[Stage::kLabel].Record(stage_ns_[0]);
  recorders_[Stage::kFilter].Record(stage_ns_[1]);
  recorders_[Stage::kTotal].Record(set.work_ns + update_ns);
  state_.store(first.result().state, std::memory_order_relaxed);
  if (person_) person_->Tell(MiddleOf(people_));
  const std::int64_t publish_ns = SteadyNs();
  sink_.OnSet({.frame = set.frame,
               .capture_ns = set.capture_ns,
               .complete_ns = set.complete_ns,
               .cameras = set.cameras,
               .acquisition_frames = first.acquisition_frames(),
               .result = first.result(),
               .body = first.body(),
               .people = people_.people(),
               .grid = set.grid,
               .outlines = set.outlines,
               .doubtful = set.doubtful,
               .person_box_W = set.person_box_W});
  recorders_[Stage::kPublish].Record(SteadyNs() - publish_ns);
  const std::int64_t from_ns =
      origin_ == LatencyOrigin::kCapture ? set.capture_ns : set.complete_ns;
  recorders_[Stage::kLatency].Record(TimelineNs() - from_ns);
  sets_.fetch_add(1, std::memory_order_relaxed);
}

// When the clock is put back, the tracker's time does not go back.
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
