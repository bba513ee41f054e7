// Heads that have to be asked where they point.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "drivers/angle_track.h"
#include "drivers/pan_tilt.h"

namespace mocap {

/// Asks a head once a frame, and goes back to it when it went away.
class PolledPanTilt : public PanTilt {
 public:
  /// @param device  as a person named it.
  /// @param delay   by which a reading lags behind the head.
  PolledPanTilt(std::string device, std::chrono::nanoseconds delay)
      : device_(std::move(device)), delay_(delay) {}

  void Start() override;
  void Stop() override;
  /// Comes back by itself when the head does.
  void Update() override;
  PanTiltAngles At(std::int64_t capture_ns) const override { return track_.At(capture_ns); }
  bool TurnTo(const PanTiltAngles& angles) override;
  PanTiltLimits limits() const override { return limits_; }

 protected:
  /// @throws SetupError  when there is no such head; then there is nothing to disconnect.
  virtual PanTiltLimits Connect() = 0;
  virtual void Disconnect() = 0;
  /// @return  nothing when the head does not answer.
  virtual std::optional<PanTiltAngles> Ask() = 0;
  /// @return  false when the head does not answer.
  virtual bool Send(const PanTiltAngles& angles) = 0;
  /// Whether a head that is away may just have come back. Without it, it is looked for now and
  /// then.
  virtual bool MayHaveReturned() { return false; }

  const std::string& device() const { return device_; }

 private:
  using Steady = std::chrono::steady_clock;

  void Reach();
  bool Read();

  const std::string device_;
  const std::chrono::nanoseconds delay_;
  bool is_connected_ = false;
  Steady::time_point last_attempt_;
  PanTiltLimits limits_;
  AngleTrack track_;
};

}  // namespace mocap
