// The way of frames through the daemon, as the service sees it.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "core/make_motion_capture.h"
#include "core/motion_capture.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "daemon/pipeline/camera_status.h"
#include "daemon/pipeline/frame_progress.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/silhouette_source.h"
#include "daemon/pipeline/spsc_queue.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/tap.h"
#include "drivers/background_source.h"
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
  /// Whoever gets frames: one tap a camera that has a driver; these come first. Borrowed for the
  /// pipeline's life.
  std::vector<std::deque<FrameTap>*> taps = {};
  /// Whoever gets previews, likewise; null: nobody.
  std::deque<PreviewTap>* previews = nullptr;
  /// Of cameras without a driver.
  OpenElsewhere elsewhere = nullptr;
  /// Learning gives up when this becomes true. Borrowed; null: it does not.
  const std::atomic<bool>* stop = nullptr;
};

/// How a frame path does; counters never go back.
struct PipelineStatus {
  bool tracks = true;  ///< Else silhouettes are handed on, and there are no sets.
  CaptureState state = CaptureState::kSearching;
  std::int64_t sets_complete = 0;  ///< With every camera.
  std::int64_t sets_partial = 0;   ///< Went on without some camera.
  std::int64_t sets_dropped = 0;   ///< Let go because the pipeline was behind.
  std::int64_t sets_tracked = 0;   ///< Handed on: sets, or silhouettes.
  std::vector<CameraStatus> cameras;
  StageHistograms stages;
};

/// From cameras to whatever is handed on: poses, or silhouettes. RequestStop, finished,
/// ReplaceBackground, Status and Progress: any thread.
class FramePath {
 public:
  virtual ~FramePath() = default;

  virtual void Start() = 0;
  /// Ends the flow at the cameras; what is under way still arrives.
  virtual void RequestStop() = 0;
  /// The last item has been handed on.
  virtual bool finished() const = 0;
  /// Waits for the threads in the order of the flow.
  /// @throws what one of them threw, SetupError of a camera that does not start among it.
  virtual void Join() = 0;

  /// Segments a camera's frames against other pictures of the empty studio from now on; learns
  /// them in the calling thread. One call at a time.
  /// @throws SetupError  for pictures that cannot be used; std::runtime_error for a camera whose
  /// thread does not take them over.
  virtual void ReplaceBackground(int camera, std::span<const BackgroundFrame> background) = 0;

  virtual PipelineStatus Status() const = 0;
  /// How far each thread has come.
  virtual FrameProgress Progress() const = 0;
};

}  // namespace mocap
