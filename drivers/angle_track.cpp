#include "drivers/angle_track.h"

#include <algorithm>

namespace mocap {

void AngleTrack::Add(std::int64_t time_ns, const PanTiltAngles& angles) {
  if (!readings_.empty() && time_ns <= readings_.back().time_ns) return;
  if (readings_.size() == kReadings) readings_.pop_front();
  readings_.push_back({time_ns, angles});
}

PanTiltAngles AngleTrack::At(std::int64_t time_ns) const {
  if (readings_.empty()) return {};
  const auto after = std::ranges::lower_bound(readings_, time_ns, {}, &Reading::time_ns);
  if (after == readings_.begin()) return after->angles;
  if (after == readings_.end()) return readings_.back().angles;
  const Reading& before = *(after - 1);
  const double share = static_cast<double>(time_ns - before.time_ns) /
                       static_cast<double>(after->time_ns - before.time_ns);
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {between(before.angles.pan_rad, after->angles.pan_rad),
          between(before.angles.tilt_rad, after->angles.tilt_rad)};
}

}  // namespace mocap
