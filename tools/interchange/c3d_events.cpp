#include "tools/interchange/c3d_events.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/kinematics/gait_events.h"

namespace mocap {
namespace {

/// Contexts and icons as Vicon's programs have them.
const char* ContextOf(Side side) { return side == Side::kLeft ? "Left" : "Right"; }

int IconOf(GaitEventKind kind) { return kind == GaitEventKind::kFootStrike ? 1 : 2; }

}  // namespace

double C3dClock::At(double moment_ns) const {
  const auto after = std::ranges::upper_bound(capture_ns, static_cast<std::int64_t>(moment_ns));
  const auto i = static_cast<std::size_t>(after - capture_ns.begin());
  if (i == 0) return file_s.front();
  if (i == capture_ns.size()) return file_s.back();
  const auto before_ns = static_cast<double>(capture_ns[i - 1]);
  const double share = (moment_ns - before_ns) / (static_cast<double>(capture_ns[i]) - before_ns);
  return std::lerp(file_s[i - 1], file_s[i], share);
}

C3dEvents::C3dEvents(std::vector<std::string> subjects)
    : subjects_(std::move(subjects)), last_s_(subjects_.size(), -1) {}

void C3dEvents::Note(std::size_t subject, bool is_tracked, double time_s) {
  const bool was_tracked = last_s_[subject] >= 0;
  if (is_tracked && !was_tracked) AddGeneral("Tracking starts", subject, time_s);
  if (!is_tracked && was_tracked) AddGeneral("Tracking ends", subject, last_s_[subject]);
  last_s_[subject] = is_tracked ? time_s : -1;
}

void C3dEvents::NoteSteps(std::size_t subject, const Result& result, const C3dClock& clock) {
  for (const GaitEvent& event : GaitEventsOf(result)) {
    const auto start_ns = static_cast<double>(result.poses.front().timestamp_ns);
    events_.push_back({std::string(kGaitEventNames[static_cast<std::size_t>(event.kind)]),
                       subjects_[subject], clock.At(start_ns + 1e9 * event.time_s),
                       ContextOf(event.side), IconOf(event.kind)});
  }
}

std::vector<C3dEvent> C3dEvents::Take() {
  for (std::size_t i = 0; i < subjects_.size(); ++i) Note(i, false, 0);
  std::ranges::stable_sort(events_, {}, &C3dEvent::time_s);
  return std::move(events_);
}

void C3dEvents::AddGeneral(const char* label, std::size_t subject, double time_s) {
  events_.push_back({label, subjects_[subject], time_s});
}

}  // namespace mocap
