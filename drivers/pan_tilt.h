// Pan-tilt heads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <string>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// What V4L2 and UVC count angles in.
inline constexpr double kArcSecond_rad = std::numbers::pi / (180 * 3600);

/// Range of a head's angles.
struct PanTiltLimits {
  PanTiltAngles least, most;

  bool Contain(const PanTiltAngles& angles) const {
    return angles.pan_rad >= least.pan_rad && angles.pan_rad <= most.pan_rad &&
           angles.tilt_rad >= least.tilt_rad && angles.tilt_rad <= most.tilt_rad;
  }
};

/// Explains in one line that a head cannot reach these angles, and gives its range.
std::string OutOfReach(const PanTiltAngles& angles, const PanTiltLimits& limits);

/// A pan-tilt head with any drive. Angles count from the head's own zero, in its own sense; the
/// axes in the calibration define them. Bound to the thread of its camera.
class PanTilt {
 public:
  virtual ~PanTilt() = default;
  /// @throws SetupError  when there is no such head.
  virtual void Start() = 0;
  virtual void Stop() = 0;
  /// Asks the head for its angles; call about once a frame.
  virtual void Update() = 0;
  /// Returns the angles at a time on the timeline, interpolated between readings.
  virtual PanTiltAngles At(std::int64_t capture_ns) const = 0;
  /// Starts to turn. @return  false if the head cannot reach the angles or does not answer.
  virtual bool TurnTo(const PanTiltAngles& angles) = 0;
  virtual PanTiltLimits limits() const = 0;
};

/// A head at constant angles.
class FixedPanTilt : public PanTilt {
 public:
  explicit FixedPanTilt(const PanTiltAngles& angles) : angles_(angles) {}
  void Start() override {}
  void Stop() override {}
  void Update() override {}
  PanTiltAngles At(std::int64_t) const override { return angles_; }
  bool TurnTo(const PanTiltAngles& angles) override { return angles == angles_; }
  PanTiltLimits limits() const override { return {angles_, angles_}; }

 private:
  PanTiltAngles angles_;
};

}  // namespace mocap
