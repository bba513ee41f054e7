// A camera whose silhouettes are given, as masks.
#pragma once

#include <memory>

#include "daemon/pipeline/camera_counters.h"
#include "daemon/pipeline/silhouette_source.h"
#include "drivers/studio.h"

namespace mocap {

/// Takes a picture's white pixels as the silhouette. Nothing beside it is dark, as by a shadow.
class MaskedCamera : public SilhouetteSource {
 public:
  /// @param masks  delivers masks of the calibration's size instead of pictures.
  /// @param rays  maximum number per outline.
  MaskedCamera(const CameraCalibration& calibration, std::unique_ptr<CameraDriver> masks, int rays);

  void Start() override { masks_->Start(); }
  void Stop() override;
  Outcome Next(const std::atomic<std::int64_t>& wanted_from_ns, SegmentedFrame& frame) override;

  const CameraCalibration& calibration() const override { return calibration_; }
  Expectation expectation() const override { return counters_.expectation(); }
  std::int64_t newest_ns() const override { return counters_.newest_ns(); }
  CameraStatus Status() const override;

 private:
  const CameraCalibration calibration_;
  const std::unique_ptr<CameraDriver> masks_;
  const int rays_;
  CameraCounters counters_;
};

/// Takes the drivers, which deliver masks, out of a studio.
/// @return  opens each of its cameras once, as a MaskedCamera.
OpenElsewhere TakeMaskedCameras(Studio& studio);

}  // namespace mocap
