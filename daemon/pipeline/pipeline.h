// The whole pipeline from frames to poses, and its threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/body/body_model.h"
#include "daemon/pipeline/camera_lines.h"
#include "daemon/pipeline/carve_stage.h"
#include "daemon/pipeline/doorbell.h"
#include "daemon/pipeline/frame_path.h"
#include "daemon/pipeline/grid_shelf.h"
#include "daemon/pipeline/health_watch.h"
#include "daemon/pipeline/keypoint_feed.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/side_thread.h"
#include "daemon/pipeline/spsc_queue.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/tap.h"
#include "daemon/pipeline/thread_group.h"
#include "daemon/pipeline/track_stage.h"
#include "drivers/studio.h"

namespace mocap {

/// @throws SetupError  when a studio has no cameras, or too many.
void RequireCameraCount(const Studio& studio);

/// Runs a studio: one thread per camera that grabs and segments, one that matches and carves, one
/// that tracks and hands on. Bounded queues between them recycle their items, so that nothing is
/// allocated, locked or copied on a frame's path. A live pipeline has one more thread that looks
/// for people who enter; the sets that show them are copied for it.
///
/// Run once, with Start and Join or with RunSerially. ChangeSubject, KnowPeople and NamePerson: any
/// thread.
class Pipeline : public FramePath {
 public:
  /// Learns every camera's background.
  /// @param sink  called from the last thread; borrowed for the pipeline's life.
  /// @throws SetupError  for cameras or backgrounds that cannot be used; LearningStopped.
  Pipeline(Studio studio, const PipelineOptions& options, const BodyTable& body, PoseSink& sink);
  ~Pipeline() override;

  void Start() override;
  void RequestStop() override { threads_.RequestStop(); }
  bool finished() const override { return finished_.load(std::memory_order_acquire); }
  void Join() override { threads_.Join(); }

  /// Does everything in the calling thread, without dropping: the reference for the threads.
  void RunSerially();

  /// From the next set on, tracks a person of these sizes. Without sizes, measures those who are
  /// present.
  void ChangeSubject(const std::optional<KnownPerson>& subject);
  /// From the next set on, a person whose sizes match one of these gets that name.
  void KnowPeople(const std::vector<KnownPerson>& people) { track_.KnowPeople(people); }
  void NamePerson(int id, const std::string& name) { track_.NamePerson(id, name); }

  void ReplaceBackground(int camera, std::span<const BackgroundFrame> background) override {
    lines_->ReplaceBackground(camera, background);
  }
  PipelineStatus Status() const override;
  /// What the cameras saw at some moments of a take. @pre  all threads have ended.
  std::span<const SeenMoment> Moments() const { return history_.moments(); }
  FrameProgress Progress() const override;

 private:
  void RunCarving();
  void HoldTaps();
  void RunTracking();
  void Track(const CarvedSet& set);
  bool FeedFromQueues();
  bool FeedSerially();

  const PipelineOptions options_;
  ThreadGroup threads_;
  StageRecorders recorders_;
  Doorbell carve_bell_;
  Doorbell track_bell_;
  std::unique_ptr<HealthWatch> health_;  ///< Live only.
  MomentHistory history_;                ///< Of a take.
  std::unique_ptr<CarveStage> carve_;
  SpscQueue<CarvedSet> sets_;
  GridShelf grids_;                   ///< Of sets_.
  std::unique_ptr<SideThread> side_;  ///< Live, with several people.
  std::optional<KeypointFeed> keypoints_;
  TrackStage track_;
  std::deque<TrackStage> others_;  ///< Of options_.other_starts.
  std::unique_ptr<CameraLines> lines_;
  bool taps_are_held_ = false;
  std::atomic<std::int64_t> carving_turns_{0};
  std::atomic<bool> carving_has_ended_{false};
  std::atomic<bool> finished_{false};
};

}  // namespace mocap
