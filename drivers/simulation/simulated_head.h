// A simulated pan-tilt head.
#pragma once

#include <cstdint>

#include "drivers/pan_tilt.h"

namespace mocap {

/// Turns at a constant speed about each axis, in the time of its camera's frames. Thread-bound.
class SimulatedHead : public PanTilt {
 public:
  static constexpr double kSpeed_rad_s = 1.5;

  explicit SimulatedHead(const PanTiltLimits& limits) : limits_(limits) {}

  /// Sets the current time: commands take effect from then on.
  void Advance(std::int64_t now_ns) { now_ns_ = now_ns; }

  void Start() override {}
  void Stop() override {}
  void Update() override {}
  PanTiltAngles At(std::int64_t capture_ns) const override;
  bool TurnTo(const PanTiltAngles& angles) override;
  PanTiltLimits limits() const override { return limits_; }

 private:
  PanTiltLimits limits_;
  PanTiltAngles from_, to_;
  std::int64_t since_ns_ = 0, now_ns_ = 0;
};

}  // namespace mocap
