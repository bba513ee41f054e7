// From photons to poses: who runs when.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/body/body_model.h"
#include "core/make_motion_capture.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "daemon/pipeline/camera_worker.h"
#include "daemon/pipeline/carve_stage.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/frame_progress.h"
#include "daemon/pipeline/grid_memory.h"
#include "daemon/pipeline/health_watch.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/side_thread.h"
#include "daemon/pipeline/spsc_queue.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/tap.h"
#include "daemon/pipeline/track_stage.h"
#include "drivers/studio.h"

namespace mocap {

struct PipelineOptions {
  SegmentationOptions segmentation{};
  double voxel_mm = 25;
  /// kWait: every set is tracked, and the poses depend on the frames alone, not on the threads.
  /// kDropOldest: the newest set counts, stale ones go, and a camera that is late is gone on
  /// without.
  Overflow overflow = Overflow::kDropOldest;
  LatencyOrigin latency_origin = LatencyOrigin::kCapture;
  TrackerKind tracker = TrackerKind::kSurface;
  int people = 1;                 ///< Followed at most.
  int priority = 0;               ///< Of the threads, SCHED_FIFO; 0: as everybody.
  std::vector<int> processors{};  ///< That the threads keep to; empty: all.
  /// Whoever gets frames: one tap a camera. Borrowed for the pipeline's life.
  std::vector<std::deque<FrameTap>*> taps = {};
  /// Whoever gets previews, likewise; null: nobody.
  std::deque<PreviewTap>* previews = nullptr;
  /// Learning gives up when this becomes true. Borrowed; null: it does not.
  const std::atomic<bool>* stop = nullptr;
};

/// Learning was given up because the program shall end.
struct LearningStopped {};

/// @throws SetupError  when a studio has no cameras, or too many.
void RequireCameraCount(const Studio& studio);

/// Learns what each camera sees of the empty studio, all at the same time.
/// @param stop  as PipelineOptions::stop. @throws SetupError of the first camera whose pictures
/// cannot be used; LearningStopped.
std::vector<Segmenter> LearnBackgrounds(const std::vector<StudioCamera>& cameras,
                                        const SegmentationOptions& options,
                                        const std::atomic<bool>* stop = nullptr);

/// How the pipeline does; counters never go back.
struct PipelineStatus {
  CaptureState state = CaptureState::kSearching;
  std::int64_t sets_complete = 0;  ///< With every camera.
  std::int64_t sets_partial = 0;   ///< Went on without some camera.
  std::int64_t sets_dropped = 0;   ///< Let go because the pipeline was behind.
  std::int64_t sets_tracked = 0;   ///< Handed on.
  std::vector<CameraStatus> cameras;
  StageHistograms stages;
};

/// Runs a studio: a thread a camera that grabs and segments, one that matches and carves, one that
/// tracks and hands on. Between them bounded queues whose items go round, so that nothing is
/// allocated, locked or copied on a frame's way. Live, one more looks for people who come in; for
/// that the sets that show them are copied.
///
/// Run once, with Start and Join or with RunSerially. RequestStop, finished, ChangeSubject,
/// ReplaceBackground, Status and Progress: any thread.
class Pipeline {
 public:
  /// Learns every camera's background.
  /// @param sink  called from the last thread; borrowed for the pipeline's life.
  /// @throws SetupError  for cameras or backgrounds that cannot be used; LearningStopped.
  Pipeline(Studio studio, const PipelineOptions& options, const BodyTable& body, PoseSink& sink);
  ~Pipeline();

  void Start();
  /// Ends the flow at the cameras; what is under way still arrives.
  void RequestStop() { stop_.store(true, std::memory_order_relaxed); }
  /// The last set has been handed on.
  bool finished() const { return finished_.load(std::memory_order_acquire); }
  /// Waits for the threads in the order of the flow.
  /// @throws what one of them threw, SetupError of a camera that does not start among it.
  void Join();

  /// Does everything in the calling thread, without dropping: the measure for the threads.
  void RunSerially();

  /// From the next set on, follows a person of these sizes; without sizes, measures whoever is
  /// there.
  void ChangeSubject(const std::optional<KnownPerson>& subject) { track_.ChangeSubject(subject); }
  /// From the next set on, whoever has the sizes of one of these people gets his name.
  void KnowPeople(const std::vector<KnownPerson>& people) { track_.KnowPeople(people); }
  void NamePerson(int id, const std::string& name) { track_.NamePerson(id, name); }

  /// Segments a camera's frames against other pictures of the empty studio from now on; learns
  /// them in the calling thread. One call at a time.
  /// @throws SetupError  for pictures that cannot be used; std::runtime_error for a camera whose
  /// thread does not take them over.
  void ReplaceBackground(int camera, std::span<const BackgroundFrame> background);

  PipelineStatus Status() const;
  /// How far each thread has come.
  FrameProgress Progress() const;

 private:
  struct CameraLine;

  void RunCamera(CameraLine& line);
  void RunCarving();
  void HoldTaps();
  void RunTracking();
  bool FeedFromQueues();
  bool FeedSerially();
  template <typename Body>
  void Launch(const std::string& name, Body body);
  template <typename Body>
  void Guard(Body body);

  const PipelineOptions options_;
  StageRecorders recorders_;
  Doorbell carve_bell_;
  Doorbell track_bell_;
  std::vector<std::unique_ptr<CameraLine>> lines_;
  std::unique_ptr<HealthWatch> health_;  ///< Live only.
  std::unique_ptr<CarveStage> carve_;
  SpscQueue<CarvedSet> sets_;
  GridMemory grids_;                  ///< Of sets_.
  std::unique_ptr<SideThread> side_;  ///< Live, where several people are followed.
  TrackStage track_;
  std::vector<std::thread> threads_;
  bool taps_are_held_ = false;
  std::atomic<std::int64_t> carving_turns_{0};
  std::atomic<bool> carving_has_ended_{false};
  std::atomic<bool> stop_{false};
  std::atomic<bool> finished_{false};
  std::atomic<bool> has_failed_{false};
  std::exception_ptr failure_;  ///< Written by the first to fail, read after joining.
};

}  // namespace mocap
