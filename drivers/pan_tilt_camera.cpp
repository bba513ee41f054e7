#include "drivers/pan_tilt_camera.h"

#include <utility>

namespace mocap {

PanTiltCamera::PanTiltCamera(std::unique_ptr<CameraDriver> camera, std::shared_ptr<PanTilt> head,
                             std::optional<HeadFollower> follower)
    : camera_(std::move(camera)), head_(std::move(head)), follower_(std::move(follower)) {}

void PanTiltCamera::Start() {
  camera_->Start();
  head_->Start();
}

GrabStatus PanTiltCamera::Grab(Frame& frame, std::chrono::milliseconds timeout) {
  const GrabStatus status = camera_->Grab(frame, timeout);
  // The frame's exposure is in the past, between this reading and the one before.
  head_->Update();
  if (status != GrabStatus::kFrame) return status;
  frame.angles = head_->At(frame.capture_ns);
  if (follower_) follower_->Follow(*head_, frame.angles, frame.capture_ns);
  return status;
}

void PanTiltCamera::Stop() {
  head_->Stop();
  camera_->Stop();
}

}  // namespace mocap
