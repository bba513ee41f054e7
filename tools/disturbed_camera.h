// A camera whose pictures are worse than they could be, to find out what tracking bears.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>

#include "core/image.h"
#include "drivers/camera_driver.h"

namespace mocap {

/// What goes wrong with a camera's pictures.
struct PictureDisturbance {
  /// Share of each picture that squares cover, anew in every frame: every other one shows the empty
  /// studio, a hole in whoever stands there, and the others a grey that is nobody.
  double covered_share = 0;
  /// No frames come from this capture time on.
  std::int64_t lost_from_ns = std::numeric_limits<std::int64_t>::max();
  std::uint64_t seed = 1;
};

/// Passes on another camera's frames, disturbed. Same frames, same disturbance.
class DisturbedCamera : public CameraDriver {
 public:
  /// @param empty  the camera's picture of the empty studio.
  DisturbedCamera(std::unique_ptr<CameraDriver> camera, Image<Bgr> empty,
                  const PictureDisturbance& disturbance);

  void Start() override { camera_->Start(); }
  GrabStatus Grab(Frame& frame, std::chrono::milliseconds timeout) override;
  void Stop() override { camera_->Stop(); }

 private:
  void Cover(const Frame& frame);

  const std::unique_ptr<CameraDriver> camera_;
  const Image<Bgr> empty_;
  const PictureDisturbance disturbance_;
  Image<Bgr> picture_;
};

}  // namespace mocap
