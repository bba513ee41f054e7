// A camera on a head.
#pragma once

#include <memory>

#include "drivers/camera_driver.h"
#include "drivers/pan_tilt.h"

namespace mocap {

/// Gives each frame of a camera the angles of its head at the moment of exposure.
class PanTiltCamera : public CameraDriver {
 public:
  PanTiltCamera(std::unique_ptr<CameraDriver> camera, std::unique_ptr<PanTilt> head);

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;
  CameraFacts Facts() const override { return camera_->Facts(); }

  PanTilt& head() { return *head_; }

 private:
  const std::unique_ptr<CameraDriver> camera_;
  const std::unique_ptr<PanTilt> head_;
};

}  // namespace mocap
