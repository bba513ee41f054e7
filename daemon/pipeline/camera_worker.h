// Processes one local camera, from its driver to silhouettes.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/reconstruction/silhouette/segmenter.h"
#include "daemon/pipeline/camera_counters.h"
#include "daemon/pipeline/pacer.h"
#include "daemon/pipeline/silhouette_source.h"
#include "daemon/pipeline/stage.h"
#include "daemon/pipeline/tap.h"
#include "drivers/studio.h"

namespace mocap {

/// Grabs and segments one camera's frames.
class CameraWorker : public SilhouetteSource {
 public:
  /// @param recorders  borrowed for the worker's life.
  /// @param taps       get every frame; borrowed likewise.
  /// @param preview    gets some frames a second with silhouettes; likewise; may be null.
  /// @param rays  maximum number per outline; 0: it is not traced.
  CameraWorker(StudioCamera camera, Segmenter segmenter, StageRecorders& recorders,
               std::vector<FrameTap*> taps = {}, PreviewTap* preview = nullptr,
               int rays = kRaysPerPerson);

  void Start() override { camera_.driver->Start(); }
  void Stop() override;
  Outcome Next(const std::atomic<std::int64_t>& wanted_from_ns, SegmentedFrame& frame) override;

  /// Segments against another background from the next frame on. Call from any thread but the
  /// worker's, one call at a time. Waits until the worker has taken it; the old segmenter is then
  /// destroyed in the calling thread. @return  false when the worker does not respond.
  bool Replace(Segmenter segmenter);

  const CameraCalibration& calibration() const override { return camera_.calibration; }
  Expectation expectation() const override { return counters_.expectation(); }
  std::int64_t newest_ns() const override { return counters_.newest_ns(); }
  CameraStatus Status() const override;

 private:
  void TakeReplacement();
  void OfferPreview(const Frame& frame, const SegmentedFrame& segmented);
  void TellConditions(SegmentedFrame& frame) const;
  void Enter(CameraState state);

  StudioCamera camera_;
  Segmenter segmenter_;
  StageRecorders& recorders_;
  const std::vector<FrameTap*> taps_;
  PreviewTap* const preview_;
  const int rays_;
  Pacer preview_pacer_{kPreviewHz};
  std::mutex replacement_mutex_;  ///< The worker tries it, but never waits.
  std::optional<Segmenter> replacement_;
  std::atomic<bool> replacement_waits_{false};
  CameraCounters counters_;
  mutable std::mutex remarks_mutex_;
  std::vector<std::string> remarks_;
  std::string time_source_;
};

}  // namespace mocap
