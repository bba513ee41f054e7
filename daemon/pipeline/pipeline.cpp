#include "daemon/pipeline/pipeline.h"

#include <cmath>
#include <string>
#include <utility>

#include "config/open_studio.h"
#include "core/errors.h"

namespace mocap {
namespace {

/// Maximum number of sets between threads. Live, finding a person who enters takes time while
/// cameras continue.
constexpr std::size_t kPatientSets = 4, kLiveSets = LoadControl::kMostUnderWay;

constexpr std::size_t SetsFor(Overflow overflow) {
  return overflow == Overflow::kWait ? kPatientSets : kLiveSets;
}

/// Live: how many periods other cameras may be ahead before a set does without one.
constexpr double kPatiencePeriods = 1.75;
// When a set does without a camera, up to a period later, it must not be too old.
static_assert(kPatiencePeriods + 1 < LoadControl::kTolerancePeriods);
/// Delay of tracking at which recordings have to wait, and at which they may continue.
constexpr std::int64_t kFarBehindNs = 250'000'000;
constexpr std::int64_t kKeepsUpNs = 50'000'000;

std::size_t CountCameras(const Studio& studio) {
  RequireCameraCount(studio);
  return studio.cameras.size();
}

ThreadOptions ThreadsFor(const PipelineOptions& options) {
  return {.priority = options.priority,
          .processors = options.processors,
          .in_long_turns = options.overflow == Overflow::kWait};
}

/// A set whose grid comes from the shelf.
CarvedSet SetWithoutGrid(std::size_t cameras, double voxel_mm) {
  CarvedSet set = RoomySet(cameras, voxel_mm);
  set.grid.Release();
  return set;
}

std::unique_ptr<SideThread> MakeSide(const PipelineOptions& options, SideThread::Guard guard) {
  const bool is_wanted = options.people > 1 && options.overflow == Overflow::kDropOldest;
  if (!is_wanted) return nullptr;
  return std::make_unique<SideThread>("newcomers", ThreadsFor(options), std::move(guard));
}

PeopleCapture MakePeople(const PipelineOptions& options, const BodyTable& body, SideThread* side) {
  return PeopleCapture(
      [kind = options.tracker, body] { return MakeMotionCapture(kind, body); },
      {.most = options.people, .fineness = FinenessFor(options.people), .side = side});
}

Synchronizer MakeSynchronizer(const Studio& studio, Overflow overflow) {
  const bool is_live = overflow == Overflow::kDropOldest;
  return Synchronizer(static_cast<int>(studio.cameras.size()),
                      std::llround(1e9 / studio.fps_nominal),
                      is_live ? kPatiencePeriods : Synchronizer::kWaitForever);
}

}  // namespace

void RequireCameraCount(const Studio& studio) {
  if (!studio.cameras.empty() && studio.cameras.size() <= kMaxCameras) return;
  throw SetupError(studio.name + ": has " + std::to_string(studio.cameras.size()) +
                   " cameras; expected 1 to " + std::to_string(kMaxCameras));
}

Pipeline::Pipeline(Studio studio, const PipelineOptions& options, const BodyTable& body,
                   PoseSink& sink)
    : options_(options),
      threads_(ThreadsFor(options)),
      sets_(SetsFor(options.overflow), Overflow::kWait, track_bell_,
            SetWithoutGrid(CountCameras(studio), options.voxel_mm)),
      grids_(RoomySet(0, options.voxel_mm).grid),
      side_(MakeSide(options, [this](const auto& work) { threads_.Guard(work); })),
      track_(MakePeople(options, body, side_.get()), options.latency_origin, sink, recorders_,
             studio.person) {
  for (const PipelineOptions::OtherStart& other : options.other_starts)
    others_.emplace_back(MakePeople(options, body, nullptr), options.latency_origin, *other.sink,
                         recorders_);
  const std::vector<CameraCalibration> calibrations = CalibrationsOf(studio);
  keypoints_.emplace(options.keypoints, calibrations);
  const int rays = kRaysPerPerson * FinenessFor(options.people);
  carve_ = std::make_unique<CarveStage>(
      calibrations, MakeSynchronizer(studio, options.overflow),
      CarvingOptions{.voxel_mm = options.voxel_mm,
                     .several_people = options.people > 1,
                     .hard_silhouettes = options.tracker == TrackerKind::kMikic2003},
      rays, recorders_);
  if (options.overflow == Overflow::kDropOldest) {
    carve_->ControlLoad();
    health_ = std::make_unique<HealthWatch>(calibrations);
    carve_->Show(health_->tap());
  } else {
    carve_->Keep(history_);
  }
  lines_ = std::make_unique<CameraLines>(std::move(studio.cameras), options, rays, recorders_,
                                         carve_bell_);
}

Pipeline::~Pipeline() { threads_.End(); }

void Pipeline::Start() {
  lines_->Launch(threads_, carve_->wanted_from_ns());
  // Work on a set must not delay the next frames: cameras have few buffers.
  threads_.LaunchBelow("carve", [this] {
    threads_.Guard([this] { RunCarving(); });
    carving_has_ended_.store(true, std::memory_order_relaxed);
    lines_->Close();
    sets_.Close();
  });
  threads_.LaunchBelow("track", [this] {
    threads_.Guard([this] { RunTracking(); });
    sets_.Close();
    finished_.store(true, std::memory_order_release);
  });
}

bool Pipeline::FeedFromQueues() {
  bool all_ended = true;
  for (int i = 0; i < carve_->camera_count(); ++i) {
    CameraLine& line = (*lines_)[i];
    // Query the state before the queue: whatever arrives in between rings the bell.
    const bool is_closed = line.queue.closed();
    const Expectation expectation = line.source->expectation();
    while (carve_->NeedsFrame(i) && line.queue.TryPop()) carve_->Offer(i, line.queue.front());
    line.ended = is_closed && carve_->NeedsFrame(i);
    carve_->synchronizer().Expect(i, line.ended ? Expectation::kNone : expectation);
    // The last frame of a lost camera says nothing about the others.
    if (expectation != Expectation::kNone) {
      carve_->synchronizer().NoteNewest(i, line.source->newest_ns());
    }
    all_ended &= line.ended;
  }
  return all_ended;
}

void Pipeline::RunCarving() {
  for (;;) {
    const int seen = carve_bell_.count();
    carving_turns_.fetch_add(1, std::memory_order_relaxed);
    carve_->SetTracked(track_.sets());
    HoldTaps();
    const bool all_ended = FeedFromQueues();
    grids_.Take(sets_.back().grid);
    const Synchronizer::Decision decision = carve_->Next(sets_.back());
    if (decision == Synchronizer::Decision::kSet) sets_.Push();
    if (decision != Synchronizer::Decision::kWait) continue;
    if (all_ended) return;
    carve_bell_.WaitPast(seen);
  }
}

// Poses have priority over recordings.
void Pipeline::HoldTaps() {
  const std::int64_t behind_ns = carve_->under_way() * carve_->synchronizer().PeriodNs();
  const bool is_held = behind_ns > (taps_are_held_ ? kKeepsUpNs : kFarBehindNs);
  if (is_held == taps_are_held_) return;
  taps_are_held_ = is_held;
  for (std::deque<FrameTap>* of_all : options_.taps) {
    for (FrameTap& tap : *of_all) tap.Hold(is_held);
  }
}

void Pipeline::RunTracking() {
  for (;;) {
    const int seen = track_bell_.count();
    const bool is_closed = sets_.closed();
    if (sets_.TryPop()) {
      Track(sets_.front());
      grids_.Give(sets_.front().grid);
      carve_bell_.Ring();
    } else if (is_closed) {
      return;
    } else {
      track_bell_.WaitPast(seen);
    }
  }
}

// Everything before tracking is as without sets left out: what cameras show stays the same.
void Pipeline::Track(const CarvedSet& set) {
  const std::vector<KeypointRays>& keypoints = keypoints_->For(set);
  if (set.frame >= options_.first_set) track_.Process(set, keypoints);
  keypoints_->Tell(track_.people());
  for (std::size_t i = 0; i < others_.size(); ++i)
    if (set.frame >= options_.other_starts[i].first_set) others_[i].Process(set, keypoints);
}

void Pipeline::ChangeSubject(const std::optional<KnownPerson>& subject) {
  track_.ChangeSubject(subject);
  for (TrackStage& other : others_) other.ChangeSubject(subject);
}

bool Pipeline::FeedSerially() {
  bool all_ended = true;
  for (int i = 0; i < carve_->camera_count(); ++i) {
    CameraLine& line = (*lines_)[i];
    while (carve_->NeedsFrame(i) && !line.ended) {
      const auto outcome = line.source->Next(carve_->wanted_from_ns(), line.queue.back());
      if (outcome == SilhouetteSource::Outcome::kFrame) carve_->Offer(i, line.queue.back());
      line.ended = outcome == SilhouetteSource::Outcome::kEnd || threads_.is_stopped();
    }
    carve_->synchronizer().Expect(i, line.ended ? Expectation::kNone : Expectation::kCertain);
    all_ended &= line.ended && carve_->NeedsFrame(i);
  }
  return all_ended;
}

void Pipeline::RunSerially() {
  for (int i = 0; i < lines_->count(); ++i) (*lines_)[i].source->Start();
  for (bool all_ended = false; !all_ended;) {
    all_ended = FeedSerially();
    while (carve_->Next(sets_.back()) == Synchronizer::Decision::kSet) Track(sets_.back());
  }
  for (int i = 0; i < lines_->count(); ++i) (*lines_)[i].source->Stop();
  finished_.store(true, std::memory_order_release);
}

PipelineStatus Pipeline::Status() const {
  PipelineStatus status;
  status.state = track_.state();
  status.sets_complete = carve_->complete_sets();
  status.sets_partial = carve_->partial_sets();
  status.sets_dropped = carve_->skipped_sets();
  status.sets_tracked = track_.sets();
  for (int i = 0; i < carve_->camera_count(); ++i) {
    CameraStatus& camera = status.cameras.emplace_back(lines_->Status(i));
    camera.late = carve_->late(i);
    camera.dropped += carve_->left_out(i) + camera.late;
  }
  if (health_) {
    const std::vector<CameraHealth> health = health_->Health();
    for (std::size_t i = 0; i < health.size(); ++i) status.cameras[i].health = health[i];
    status.people = health_->People();
  }
  status.stages = StageHistograms(recorders_);
  return status;
}

FrameProgress Pipeline::Progress() const {
  FrameProgress progress;
  progress.cameras = lines_->Progress();
  progress.carving = {carving_turns_.load(std::memory_order_relaxed),
                      carving_has_ended_.load(std::memory_order_relaxed)};
  // Read first: sets matched in between then count as waiting.
  progress.sets_tracked = track_.sets();
  progress.sets_matched = carve_->complete_sets() + carve_->partial_sets();
  return progress;
}

}  // namespace mocap
