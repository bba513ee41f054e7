// The path of frames through the daemon, as the service sees it.
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
#include "daemon/pipeline/keypoint_source.h"
#include "daemon/pipeline/people_watch.h"
#include "daemon/pipeline/pose_sink.h"
#include "daemon/pipeline/silhouette_source.h"
#include "daemon/pipeline/spsc_queue.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/tap.h"
#include "drivers/background_source.h"
#include "drivers/studio.h"

namespace mocap {

struct PipelineOptions {
  /// Another tracker of the same sets. What its first set changes can so be seen at little cost.
  struct OtherStart {
    std::int64_t first_set = 0;
    PoseSink* sink = nullptr;  ///< Borrowed for the pipeline's life.
  };

  SegmentationOptions segmentation{};
  double voxel_mm = 25;
  /// kWait: every set is tracked, and poses depend on the frames alone, not on thread timing.
  /// kDropOldest: the newest set counts, late frames are dropped, and sets go on without a late
  /// camera.
  Overflow overflow = Overflow::kDropOldest;
  LatencyOrigin latency_origin = LatencyOrigin::kCapture;
  TrackerKind tracker = TrackerKind::kSurface;
  int people = 1;              ///< Maximum number that is tracked.
  std::int64_t first_set = 0;  ///< Tracking begins with this set; earlier ones are left out.
  std::vector<OtherStart> other_starts = {};
  int priority = 0;               ///< Of the threads, SCHED_FIFO; 0: normal scheduling.
  std::vector<int> processors{};  ///< For the threads; empty: all.
  /// Recipients of frames, each with one tap per camera that has a driver; these cameras come
  /// first. Borrowed for the pipeline's life.
  std::vector<std::deque<FrameTap>*> taps = {};
  /// Recipient of previews, likewise; null: none.
  std::deque<PreviewTap>* previews = nullptr;
  /// Keypoints that count beside the silhouettes. Borrowed for the pipeline's life; null: none.
  KeypointSource* keypoints = nullptr;
  /// Opens cameras without a driver here.
  OpenElsewhere elsewhere = nullptr;
  /// Learning is abandoned when this becomes true. Borrowed; null: never.
  const std::atomic<bool>* stop = nullptr;
};

/// The state of a frame path. Counters never decrease.
struct PipelineStatus {
  bool tracks = true;  ///< Otherwise silhouettes are handed on, and there are no sets.
  CaptureState state = CaptureState::kSearching;
  std::int64_t sets_complete = 0;  ///< With every camera.
  std::int64_t sets_partial = 0;   ///< Without some camera.
  std::int64_t sets_dropped = 0;   ///< Dropped because the pipeline was behind.
  std::int64_t sets_tracked = 0;   ///< Handed on: sets, or silhouettes.
  std::vector<CameraStatus> cameras;
  SeenPeople people;  ///< Live only.
  StageHistograms stages;
};

/// The path from cameras to poses, or on a node to silhouettes. RequestStop, finished,
/// ReplaceBackground, Status and Progress: any thread.
class FramePath {
 public:
  virtual ~FramePath() = default;

  virtual void Start() = 0;
  /// Ends the flow at the cameras. What is in the pipeline still arrives.
  virtual void RequestStop() = 0;
  /// Whether the last item has been handed on.
  virtual bool finished() const = 0;
  /// Waits for the threads in the order of the flow.
  /// @throws what one of them threw, such as SetupError of a camera that does not start.
  virtual void Join() = 0;

  /// Segments a camera's frames against another background from now on. Learns it in the calling
  /// thread. One call at a time.
  /// @throws SetupError  for pictures that cannot be used; std::runtime_error if the camera's
  /// thread does not take the background.
  virtual void ReplaceBackground(int camera, std::span<const BackgroundFrame> background) = 0;

  virtual PipelineStatus Status() const = 0;
  /// Progress of each thread.
  virtual FrameProgress Progress() const = 0;
};

}  // namespace mocap
