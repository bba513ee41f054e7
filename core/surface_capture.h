// Beyond the paper: tracks a person by the surface of the flesh and the silhouettes' outlines.
#pragma once

#include <memory>

#include "core/motion_capture.h"

namespace mocap {

/// Acquires a body, fits it to the surface in every frame, loses it and acquires it again.
class SurfaceCapture : public MotionCapture {
 public:
  explicit SurfaceCapture(const BodyTable& table);
  ~SurfaceCapture() override;

  const CaptureResult& Update(const Sighting& sighting, std::int64_t capture_ns,
                              UpdateObserver* observer) override;
  void Forget() override;
  void Expect(const BodySizes& sizes) override;
  const CaptureResult& result() const override;
  PoseState PredictedPose(std::int64_t capture_ns) const override;
  const BodyModel& body() const override;
  int acquisition_frames() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mocap
