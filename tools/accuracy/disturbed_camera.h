// A camera with disturbed pictures, to test the limits of tracking.
#pragma once

#include <cstdint>
#include <memory>

#include "core/image.h"
#include "drivers/camera_driver.h"

namespace mocap {

/// Event at a camera: it fails, a light shines into it, or somebody turns it.
enum class Mishap { kNone, kLost, kBlinded, kTurned };

/// Disturbance of a camera's pictures.
struct PictureDisturbance {
  /// Share of each picture covered by squares, new in every frame. Every other square shows the
  /// empty studio, a hole in a person; the others are grey, where there is no person.
  double covered_share = 0;
  Mishap mishap = Mishap::kNone;
  std::int64_t mishap_ns = 0;  ///< Capture time from which it applies.
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
  void Copy(const Frame& frame, int shift_px);
  void Cover(std::uint64_t sequence);

  const std::unique_ptr<CameraDriver> camera_;
  const Image<Bgr> empty_;
  const PictureDisturbance disturbance_;
  Image<Bgr> picture_;
};

}  // namespace mocap
