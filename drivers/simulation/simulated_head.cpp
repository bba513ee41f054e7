#include "drivers/simulation/simulated_head.h"

#include <algorithm>

namespace mocap {

PanTiltAngles SimulatedHead::At(std::int64_t capture_ns) const {
  const double turned_rad =
      kSpeed_rad_s * 1e-9 * static_cast<double>(std::max<std::int64_t>(capture_ns - since_ns_, 0));
  const auto towards = [turned_rad](double from_rad, double to_rad) {
    return from_rad + std::clamp(to_rad - from_rad, -turned_rad, turned_rad);
  };
  return {towards(from_.pan_rad, to_.pan_rad), towards(from_.tilt_rad, to_.tilt_rad)};
}

bool SimulatedHead::TurnTo(const PanTiltAngles& angles) {
  if (!limits_.Contain(angles)) return false;
  from_ = At(now_ns_);
  since_ns_ = now_ns_;
  to_ = angles;
  return true;
}

}  // namespace mocap
