// One camera, from its driver to silhouettes.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/silhouette/outline.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "core/reconstruction/silhouette/silhouette.h"
#include "daemon/pipeline/health_watch.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/synchronizer.h"
#include "daemon/pipeline/tap.h"
#include "drivers/studio.h"

namespace mocap {

/// Most rays of an outline that one person needs; of several, outlines have more.
inline constexpr int kRaysPerPerson = 100;
inline constexpr int kMostRays = 2 * kRaysPerPerson;

/// The output of a camera's thread: silhouette and outline, no pixels.
struct SegmentedFrame {
  Silhouette silhouette;
  Outline outline;      ///< The silhouette's border.
  Shading shading;      ///< What the picture tells of shadows.
  RigidTransform X_CW;  ///< Where the camera stood.
  std::int64_t capture_ns = 0;
  std::uint64_t sequence = 0;
  std::int64_t arrival_ns = 0;  ///< When the driver handed it out, on the timeline.
  std::int64_t segment_ns = 0;  ///< How long segmentation took.
  /// Most of the picture is unlike the empty studio, or the camera looks elsewhere: whoever stands
  /// there is not to be seen, or not where calibration has him.
  bool is_blind = false;
};

/// Numbers as in camera_status_t.
enum class CameraState { kStarting = 0, kStreaming = 1, kLost = 2, kEnded = 3 };

/// A camera's counters at one moment.
struct CameraStatus {
  std::string name;
  CameraState state = CameraState::kStarting;
  std::int64_t frames = 0;
  std::int64_t dropped = 0;  ///< Gaps in the camera's count, and frames let go on the way.
  std::int64_t late = 0;     ///< Came after their set had gone, or found none.
  std::int64_t torn = 0;
  int replacements = 0;              ///< How often the background was learned since the start.
  double light = 1;                  ///< Brightness, over that of the empty studio as learned.
  double nudged_px = 0;              ///< How far the picture lies from where it was learned.
  bool is_blind = false;             ///< As the last frame's.
  CameraHealth health;               ///< Whether the other cameras agree.
  std::string waits_for;             ///< The camera that triggers it; empty: none that is known.
  std::vector<std::string> remarks;  ///< Of the driver, when the state last changed.
};

/// Grabs and segments one camera's frames. Start, Next and Stop: one thread; the rest: any.
class CameraWorker {
 public:
  /// @param recorders  borrowed for the worker's life.
  /// @param taps       get every frame, likewise.
  /// @param preview    gets some frames a second with their silhouettes, likewise; may be null.
  /// @param rays  of an outline, at the most.
  CameraWorker(StudioCamera camera, Segmenter segmenter, StageRecorders& recorders,
               std::vector<FrameTap*> taps = {}, PreviewTap* preview = nullptr,
               int rays = kRaysPerPerson);

  void Start() { camera_.driver->Start(); }
  void Stop();

  enum class Outcome { kFrame, kNothing, kEnd };
  /// Waits a moment for the next frame and segments it into `frame`; one captured before
  /// `wanted_from_ns`, as it is by then, is dropped instead, unless the clock was put back.
  Outcome Next(const std::atomic<std::int64_t>& wanted_from_ns, SegmentedFrame& frame);

  /// Segments with another knowledge of the empty studio from the next frame on. Any thread but the
  /// worker's, one at a time; waits until the worker has taken it, so that what it had before ends
  /// here. @return  false when the worker does not come round.
  bool Replace(Segmenter segmenter);

  const CameraCalibration& calibration() const { return camera_.calibration; }
  /// Whether another frame is to come. It stays kCertain until the next call of Next, so that a
  /// frame's owner has time to pass it on.
  Expectation expectation() const { return expectation_.load(std::memory_order_acquire); }
  /// Time of the newest segmented frame.
  std::int64_t newest_ns() const { return newest_ns_.load(std::memory_order_relaxed); }
  /// The worker's own counters.
  CameraStatus Status() const;

 private:
  void TakeReplacement();
  void OfferPreview(const Frame& frame, const SegmentedFrame& segmented);
  /// @return  whether the camera is blind.
  bool NoteConditions(const Silhouette& silhouette);
  void CountFrame(std::uint64_t sequence);
  void Enter(CameraState state);

  StudioCamera camera_;
  Segmenter segmenter_;
  StageRecorders& recorders_;
  const std::vector<FrameTap*> taps_;
  PreviewTap* const preview_;
  const int rays_;
  Pacer preview_pacer_{kPreviewHz};
  std::mutex replacement_mutex_;  ///< Tried, never waited for, by the worker.
  std::optional<Segmenter> replacement_;
  std::atomic<bool> replacement_waits_{false};
  std::uint64_t next_sequence_ = 0;
  std::atomic<CameraState> state_{CameraState::kStarting};
  std::atomic<Expectation> expectation_{Expectation::kPossible};
  std::atomic<std::int64_t> newest_ns_;
  std::atomic<std::int64_t> frames_{0};
  std::atomic<std::int64_t> dropped_{0};
  std::atomic<std::int64_t> torn_{0};
  std::atomic<int> replacements_{0};
  std::atomic<double> light_{1};
  std::atomic<double> nudged_px_{0};
  std::atomic<bool> is_blind_{false};
  mutable std::mutex remarks_mutex_;
  std::vector<std::string> remarks_;
};

}  // namespace mocap
