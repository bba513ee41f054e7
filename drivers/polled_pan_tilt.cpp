#include "drivers/polled_pan_tilt.h"

#include "core/errors.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::chrono::milliseconds kRetryPause{500};

}  // namespace

void PolledPanTilt::Start() {
  Reach();
  if (Read()) return;
  Stop();
  throw SetupError(device_ + ": does not report where its head points");
}

void PolledPanTilt::Stop() {
  if (is_connected_) Disconnect();
  is_connected_ = false;
}

void PolledPanTilt::Reach() {
  last_attempt_ = Steady::now();
  limits_ = Connect();
  is_connected_ = true;
}

bool PolledPanTilt::Read() {
  const std::int64_t before_ns = TimelineNs();
  const std::optional<PanTiltAngles> angles = Ask();
  if (!angles) return false;
  const std::int64_t middle_ns = (before_ns + TimelineNs()) / 2;
  track_.Add(middle_ns - delay_.count(), *angles);
  return true;
}

void PolledPanTilt::Update() {
  if (is_connected_ && !Read()) Stop();
  if (is_connected_) return;
  if (!MayHaveReturned() && Steady::now() - last_attempt_ < kRetryPause) return;
  try {
    Reach();
  } catch (const SetupError&) {
    // Still away; meanwhile frames keep its last angles.
  }
}

bool PolledPanTilt::TurnTo(const PanTiltAngles& angles) {
  return is_connected_ && limits_.Contain(angles) && Send(angles);
}

}  // namespace mocap
