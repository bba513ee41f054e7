// Heads that turn cameras.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/reconstruction/camera/camera_model.h"

namespace mocap {

/// How far a head turns.
struct PanTiltLimits {
  PanTiltAngles least, most;

  bool Contain(const PanTiltAngles& angles) const {
    return angles.pan_rad >= least.pan_rad && angles.pan_rad <= most.pan_rad &&
           angles.tilt_rad >= least.tilt_rad && angles.tilt_rad <= most.tilt_rad;
  }
};

/// Says in a line why a head does not look there, and where it can.
std::string OutOfReach(const PanTiltAngles& angles, const PanTiltLimits& limits);

/// A head, whatever turns it. Angles count from the head's own zero, in its own sense; the
/// calibration's axes say what they mean. Thread-bound, to its camera's thread.
class PanTilt {
 public:
  virtual ~PanTilt() = default;
  /// @throws SetupError  when there is no such head.
  virtual void Start() = 0;
  virtual void Stop() = 0;
  /// Asks the head where it points; about once a frame.
  virtual void Update() = 0;
  /// Gives where it pointed at a moment of the timeline, between what was read before and
  /// after it.
  virtual PanTiltAngles At(std::int64_t capture_ns) const = 0;
  /// Sets off in a direction. @return  false when the head does not reach it, or does not answer.
  virtual bool TurnTo(const PanTiltAngles& angles) = 0;
  virtual PanTiltLimits limits() const = 0;
};

/// A head that nobody turns.
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
