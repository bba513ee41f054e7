#include "daemon/pipeline/pipeline.h"

#include <pthread.h>

#include <cmath>
#include <future>
#include <stdexcept>
#include <string>
#include <utility>

#include "config/open_studio.h"
#include "core/errors.h"
#include "daemon/pipeline/realtime.h"

namespace mocap {
namespace {

/// How many items lie between threads at most: frames of each camera, and sets.
struct QueueSizes {
  std::size_t frames, sets;
};

/// Where nothing waits for a pose, every thread finds enough to do, and sets are not laid by.
constexpr QueueSizes kPatient{.frames = 8, .sets = 4};
/// Live, frames do not become old; but who comes in has to be found, and cameras go on meanwhile.
constexpr QueueSizes kLive{.frames = 4, .sets = LoadControl::kMostUnderWay};

constexpr const QueueSizes& SizesFor(Overflow overflow) {
  return overflow == Overflow::kWait ? kPatient : kLive;
}

/// Live: how many periods the other cameras may be ahead before a set goes on without one.
constexpr double kPatiencePeriods = 1.75;
// By the time that a set went on without a camera, up to a period later, it must not be too old.
static_assert(kPatiencePeriods + 1 < LoadControl::kTolerancePeriods);
/// How far tracking is behind when recordings have to wait, and when they may go on.
constexpr std::int64_t kFarBehindNs = 250'000'000;
constexpr std::int64_t kKeepsUpNs = 50'000'000;
/// Of all grids that go round together, beyond what a person needs: some dozens of a whole room.
constexpr std::size_t kMostGridBytes = 256 << 20;
constexpr std::size_t kLongestThreadName = 15;
/// Where several people may be, a small blob may be one whom others hide; share of the picture.
constexpr double kLargestThingAmongPeople = 0.003;

std::size_t CountCameras(const Studio& studio) {
  RequireCameraCount(studio);
  return studio.cameras.size();
}

/// The same pictures, until the program shall end.
BackgroundSource UntilStopped(const BackgroundSource& source, const std::atomic<bool>* stop) {
  if (!stop) return source;
  return BackgroundSource::OneByOne([&source, stop](const BackgroundSource::Visit& visit) {
    source.ForEach([&](const BackgroundFrame& frame) {
      if (stop->load(std::memory_order_relaxed)) throw LearningStopped();
      visit(frame);
    });
  });
}

/// Rays of outlines, as a multiple of those that one person needs.
int FinenessFor(int people) { return people > 1 ? kMostRays / kRaysPerPerson : 1; }

SegmentationOptions SegmentationOf(const PipelineOptions& options) {
  SegmentationOptions segmentation = options.segmentation;
  if (options.people > 1) segmentation.largest_thing_share = kLargestThingAmongPeople;
  return segmentation;
}

std::unique_ptr<SideThread> MakeSide(const PipelineOptions& options, SideThread::Guard guard) {
  const bool is_wanted = options.people > 1 && options.overflow == Overflow::kDropOldest;
  if (!is_wanted) return nullptr;
  return std::make_unique<SideThread>("newcomers", options.processors, std::move(guard));
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
                   " cameras, wanted 1 to " + std::to_string(kMaxCameras));
}

std::vector<Segmenter> LearnBackgrounds(const std::vector<StudioCamera>& cameras,
                                        const SegmentationOptions& options,
                                        const std::atomic<bool>* stop) {
  std::vector<std::future<Segmenter>> learning;
  for (const StudioCamera& camera : cameras) {
    learning.push_back(std::async(std::launch::async, [&camera, &options, stop] {
      return Segmenter(camera.calibration, UntilStopped(camera.background, stop)(), options);
    }));
  }
  std::vector<Segmenter> segmenters;
  for (auto& learned : learning) segmenters.push_back(learned.get());
  return segmenters;
}

/// One camera's thread and the queue it fills.
struct Pipeline::CameraLine {
  CameraLine(StudioCamera camera, Segmenter segmenter, StageRecorders& recorders,
             std::vector<FrameTap*> taps, PreviewTap* preview, int rays, Overflow overflow,
             Doorbell& carve_bell)
      : worker(std::move(camera), std::move(segmenter), recorders, std::move(taps), preview, rays),
        queue(SizesFor(overflow).frames, overflow, carve_bell) {}

  CameraWorker worker;
  SpscQueue<SegmentedFrame> queue;
  bool ended = false;  ///< Nothing more will come; the carving thread's view.
  std::atomic<std::int64_t> turns{0};
  std::atomic<bool> has_ended{false};  ///< The camera's thread is done.
};

Pipeline::Pipeline(Studio studio, const PipelineOptions& options, const BodyTable& body,
                   PoseSink& sink)
    : options_(options),
      sets_(SizesFor(options.overflow).sets, Overflow::kWait, track_bell_,
            RoomySet(CountCameras(studio), options.voxel_mm)),
      grids_(RoomySet(0, options.voxel_mm).grid.capacity_bytes(), kMostGridBytes),
      side_(MakeSide(options, [this](const auto& work) { Guard(work); })),
      track_(PeopleCapture([kind = options.tracker, body] { return MakeMotionCapture(kind, body); },
                           {.most = options.people,
                            .fineness = FinenessFor(options.people),
                            .side = side_.get()}),
             options.latency_origin, sink, recorders_, studio.person) {
  const std::vector<CameraCalibration> calibrations = CalibrationsOf(studio);
  const int rays = kRaysPerPerson * FinenessFor(options.people);
  carve_ = std::make_unique<CarveStage>(
      calibrations, MakeSynchronizer(studio, options.overflow),
      CarvingOptions{.voxel_mm = options.voxel_mm, .several_people = options.people > 1}, rays,
      recorders_);
  if (options.overflow == Overflow::kDropOldest) {
    carve_->ControlLoad();
    health_ = std::make_unique<HealthWatch>(calibrations);
    carve_->Show(health_->tap());
  }
  std::vector<Segmenter> segmenters =
      LearnBackgrounds(studio.cameras, SegmentationOf(options), options.stop);
  for (std::size_t i = 0; i < segmenters.size(); ++i) {
    std::vector<FrameTap*> taps;
    for (std::deque<FrameTap>* of_all : options.taps) taps.push_back(&of_all->at(i));
    PreviewTap* preview = options.previews ? &options.previews->at(i) : nullptr;
    lines_.push_back(std::make_unique<CameraLine>(
        std::move(studio.cameras[i]), std::move(segmenters[i]), recorders_, std::move(taps),
        preview, rays, options.overflow, carve_bell_));
  }
}

Pipeline::~Pipeline() {
  RequestStop();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

template <typename Body>
void Pipeline::Guard(Body body) {
  try {
    body();
  } catch (...) {
    if (!has_failed_.exchange(true)) failure_ = std::current_exception();
    RequestStop();
  }
}

template <typename Body>
void Pipeline::Launch(const std::string& name, Body body) {
  threads_.emplace_back([this, name, body] {
    pthread_setname_np(pthread_self(), name.substr(0, kLongestThreadName).c_str());
    // Whether they may is known by now; without it, frames are only more often late.
    if (options_.priority > 0) {
      TakePriority(options_.priority);
    } else if (options_.overflow == Overflow::kWait) {
      WorkInLongTurns();
    }
    KeepToProcessors(options_.processors);
    body();
  });
}

void Pipeline::Start() {
  for (const auto& line : lines_) {
    Launch(line->worker.calibration().name, [this, &line = *line] {
      Guard([&] { RunCamera(line); });
      line.has_ended.store(true, std::memory_order_relaxed);
      line.queue.Close();
    });
  }
  Launch("carve", [this] {
    Guard([&] { RunCarving(); });
    carving_has_ended_.store(true, std::memory_order_relaxed);
    for (const auto& line : lines_) line->queue.Close();
    sets_.Close();
  });
  Launch("track", [this] {
    Guard([&] { RunTracking(); });
    sets_.Close();
    finished_.store(true, std::memory_order_release);
  });
}

void Pipeline::Join() {
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Pipeline::RunCamera(CameraLine& line) {
  line.worker.Start();
  while (!stop_.load(std::memory_order_relaxed)) {
    line.turns.fetch_add(1, std::memory_order_relaxed);
    const CameraWorker::Outcome outcome =
        line.worker.Next(carve_->wanted_from_ns(), line.queue.back());
    if (outcome == CameraWorker::Outcome::kEnd) break;
    if (outcome == CameraWorker::Outcome::kFrame) {
      line.queue.Push();
    } else {
      // The carver may have to go on without this camera.
      carve_bell_.Ring();
    }
  }
  line.worker.Stop();
}

bool Pipeline::FeedFromQueues() {
  bool all_ended = true;
  for (int i = 0; i < carve_->camera_count(); ++i) {
    CameraLine& line = *lines_[i];
    // First what is on the way, then what has come: whatever comes in between rings the bell.
    const bool is_closed = line.queue.closed();
    const Expectation expectation = line.worker.expectation();
    while (carve_->NeedsFrame(i) && line.queue.TryPop()) carve_->Offer(i, line.queue.front());
    line.ended = is_closed && carve_->NeedsFrame(i);
    carve_->synchronizer().Expect(i, line.ended ? Expectation::kNone : expectation);
    // What a camera was at when it was lost says nothing about those that go on.
    if (expectation != Expectation::kNone) {
      carve_->synchronizer().NoteNewest(i, line.worker.newest_ns());
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
    const std::size_t grid_bytes = sets_.back().grid.capacity_bytes();
    const Synchronizer::Verdict verdict = carve_->Next(sets_.back());
    if (verdict == Synchronizer::Verdict::kSet) {
      grids_.NoteGrowth(grid_bytes, sets_.back().grid);
      sets_.Push();
    }
    if (verdict != Synchronizer::Verdict::kWait) continue;
    if (all_ended) return;
    carve_bell_.WaitPast(seen);
  }
}

// A pose comes before a recording.
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
      track_.Process(sets_.front());
      grids_.Bound(sets_.front().grid);
      carve_bell_.Ring();
    } else if (is_closed) {
      return;
    } else {
      track_bell_.WaitPast(seen);
    }
  }
}

bool Pipeline::FeedSerially() {
  bool all_ended = true;
  for (int i = 0; i < carve_->camera_count(); ++i) {
    CameraLine& line = *lines_[i];
    while (carve_->NeedsFrame(i) && !line.ended) {
      const CameraWorker::Outcome outcome =
          line.worker.Next(carve_->wanted_from_ns(), line.queue.back());
      if (outcome == CameraWorker::Outcome::kFrame) carve_->Offer(i, line.queue.back());
      line.ended = outcome == CameraWorker::Outcome::kEnd || stop_.load(std::memory_order_relaxed);
    }
    carve_->synchronizer().Expect(i, line.ended ? Expectation::kNone : Expectation::kCertain);
    all_ended &= line.ended && carve_->NeedsFrame(i);
  }
  return all_ended;
}

void Pipeline::RunSerially() {
  for (const auto& line : lines_) line->worker.Start();
  for (bool all_ended = false; !all_ended;) {
    all_ended = FeedSerially();
    while (carve_->Next(sets_.back()) == Synchronizer::Verdict::kSet) track_.Process(sets_.back());
  }
  for (const auto& line : lines_) line->worker.Stop();
  finished_.store(true, std::memory_order_release);
}

void Pipeline::ReplaceBackground(int camera, std::span<const BackgroundFrame> background) {
  CameraWorker& worker = lines_.at(static_cast<std::size_t>(camera))->worker;
  if (!worker.Replace(Segmenter(worker.calibration(), background, SegmentationOf(options_)))) {
    throw std::runtime_error(worker.calibration().name + " did not take over what was learned");
  }
}

PipelineStatus Pipeline::Status() const {
  PipelineStatus status;
  status.state = track_.state();
  status.sets_complete = carve_->complete_sets();
  status.sets_partial = carve_->partial_sets();
  status.sets_dropped = carve_->skipped_sets();
  status.sets_tracked = track_.sets();
  for (int i = 0; i < carve_->camera_count(); ++i) {
    CameraStatus& camera = status.cameras.emplace_back(lines_[i]->worker.Status());
    camera.late = carve_->late(i);
    camera.dropped += lines_[i]->queue.dropped() + carve_->left_out(i) + camera.late;
  }
  if (health_) {
    const std::vector<CameraHealth> health = health_->Health();
    for (std::size_t i = 0; i < health.size(); ++i) status.cameras[i].health = health[i];
  }
  status.stages = StageHistograms(recorders_);
  return status;
}

FrameProgress Pipeline::Progress() const {
  FrameProgress progress;
  for (const auto& line : lines_) {
    progress.cameras.push_back({line->turns.load(std::memory_order_relaxed),
                                line->has_ended.load(std::memory_order_relaxed)});
  }
  progress.carving = {carving_turns_.load(std::memory_order_relaxed),
                      carving_has_ended_.load(std::memory_order_relaxed)};
  // Tracked first: what is matched in between then still waits.
  progress.sets_tracked = track_.sets();
  progress.sets_matched = carve_->complete_sets() + carve_->partial_sets();
  return progress;
}

}  // namespace mocap
