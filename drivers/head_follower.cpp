#include "drivers/head_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/reconstruction/camera/head_aim.h"

namespace mocap {
namespace {

/// A slightly early frame still triggers a step.
constexpr double kShortestStep_s = 0.09, kLongestStep_s = 0.2;

/// Moves one axis by a step.
double Drawn(double from_rad, double aim_rad, double least_rad, double most_rad, double seconds) {
  const double away_rad = aim_rad - from_rad;
  const double pull_rad = std::max(std::abs(away_rad) - HeadFollower::kSlack_rad, 0.0);
  const double step_rad = std::min(pull_rad, HeadFollower::kFastest_rad_s * seconds);
  return std::max(least_rad, std::min(most_rad, from_rad + std::copysign(step_rad, away_rad)));
}

}  // namespace

HeadFollower::HeadFollower(CameraCalibration camera, const PanTiltLimits& range,
                           std::shared_ptr<const SubjectPosition> person)
    : camera_(std::move(camera)), range_(range), person_(std::move(person)) {}

void HeadFollower::Follow(PanTilt& head, const PanTiltAngles& now, std::int64_t now_ns) {
  const double seconds = static_cast<double>(now_ns - last_ns_) * 1e-9;
  // If the clock was set back, start again.
  if (seconds >= 0 && seconds < kShortestStep_s) return;
  last_ns_ = now_ns;
  const std::optional<Vector3> p_WQ = person_->Told();
  if (!p_WQ) return;
  if (!told_) told_ = now;
  const PanTiltAngles next =
      Next(AimAt(camera_, *p_WQ, *told_), head.limits(), std::clamp(seconds, 0.0, kLongestStep_s));
  if (next == *told_) return;
  // A head that does not answer is away. When it returns, it reports its angles.
  told_ = head.TurnTo(next) ? std::optional(next) : std::nullopt;
}

PanTiltAngles HeadFollower::Next(const PanTiltAngles& aim, const PanTiltLimits& limits,
                                 double seconds) const {
  const double least_pan = std::max(limits.least.pan_rad, range_.least.pan_rad);
  const double most_pan = std::min(limits.most.pan_rad, range_.most.pan_rad);
  const double least_tilt = std::max(limits.least.tilt_rad, range_.least.tilt_rad);
  const double most_tilt = std::min(limits.most.tilt_rad, range_.most.tilt_rad);
  return {Drawn(told_->pan_rad, aim.pan_rad, least_pan, most_pan, seconds),
          Drawn(told_->tilt_rad, aim.tilt_rad, least_tilt, most_tilt, seconds)};
}

}  // namespace mocap
