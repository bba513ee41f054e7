// A camera on a pan-tilt head.
#pragma once

#include <memory>
#include <optional>

#include "drivers/camera_driver.h"
#include "drivers/head_follower.h"
#include "drivers/pan_tilt.h"

namespace mocap {

/// Adds to each frame of a camera the angles of its head at the moment of exposure.
class PanTiltCamera : public CameraDriver {
 public:
  /// @param follower  keeps the subject in view; without it the head does not turn.
  PanTiltCamera(std::unique_ptr<CameraDriver> camera, std::shared_ptr<PanTilt> head,
                std::optional<HeadFollower> follower = std::nullopt);

  void Start() override;
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override;
  CameraFacts Facts() const override { return camera_->Facts(); }

  PanTilt& head() { return *head_; }

 private:
  const std::unique_ptr<CameraDriver> camera_;
  const std::shared_ptr<PanTilt> head_;
  std::optional<HeadFollower> follower_;
};

}  // namespace mocap
