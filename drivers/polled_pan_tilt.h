// Pan-tilt heads that must be polled for their angles.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "drivers/angle_track.h"
#include "drivers/pan_tilt.h"

namespace mocap {

/// Polls a head once a frame, and reconnects after it was away.
class PolledPanTilt : public PanTilt {
 public:
  /// @param device  name given by the user.
  /// @param delay   lag of a reading behind the head.
  PolledPanTilt(std::string device, std::chrono::nanoseconds delay)
      : device_(std::move(device)), delay_(delay) {}

  void Start() override;
  void Stop() override;
  /// Reconnects when the head is back.
  void Update() override;
  PanTiltAngles At(std::int64_t capture_ns) const override { return track_.At(capture_ns); }
  bool TurnTo(const PanTiltAngles& angles) override;
  PanTiltLimits limits() const override { return limits_; }

 protected:
  /// @throws SetupError  when there is no such head; then nothing needs disconnecting.
  virtual PanTiltLimits Connect() = 0;
  virtual void Disconnect() = 0;
  /// @return  nothing when the head does not answer.
  virtual std::optional<PanTiltAngles> Ask() = 0;
  /// @return  false when the head does not answer.
  virtual bool Send(const PanTiltAngles& angles) = 0;
  /// Whether a head that is away may just have come back. By default, retries are only periodic.
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
