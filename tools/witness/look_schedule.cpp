#include "tools/witness/look_schedule.h"

#include <cmath>

namespace mocap {

LookSchedule::LookSchedule(int cameras, double rate_hz)
    : cameras_(cameras), period_ns_(std::llround(1e9 / rate_hz)) {}

std::optional<int> LookSchedule::Next(int person, std::int64_t capture_ns,
                                      const std::function<bool(int camera)>& sees) {
  // Several people take turns at the cameras, too.
  Turn& turn = turns_.try_emplace(person, Turn{capture_ns, person % cameras_}).first->second;
  if (capture_ns < turn.due_ns) return std::nullopt;
  for (int i = 0; i < cameras_; ++i) {
    const int camera = (turn.camera + i) % cameras_;
    if (!sees(camera)) continue;
    turn.camera = (camera + 1) % cameras_;
    turn.due_ns += period_ns_;
    if (turn.due_ns <= capture_ns) turn.due_ns = capture_ns + period_ns_;
    return camera;
  }
  return std::nullopt;
}

}  // namespace mocap
