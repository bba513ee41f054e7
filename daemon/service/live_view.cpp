#include "daemon/service/live_view.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "drivers/clock.h"
#include "drivers/printable_text.h"

namespace mocap {

void LiveView::OnSet(const TrackedSet& set) {
  const bool is_tracking = set.result.state == CaptureState::kTracking;
  state_.store(set.result.state, std::memory_order_relaxed);
  residual_mm_.store(is_tracking ? set.result.residual_mm : kUnknown, std::memory_order_relaxed);
  voxels_.store(set.result.voxels, std::memory_order_relaxed);
  error_mm_.store(error_ && is_tracking ? error_(set) : kUnknown, std::memory_order_relaxed);
  count_.store(static_cast<int>(set.people.size()), std::memory_order_relaxed);
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock) TakePeople(set.people);
}

// Both lists are sorted by number. Allocates nothing once there is room for all.
void LiveView::TakePeople(std::span<const PersonView> people) {
  const auto is_gone = [&](const FollowedPerson& person) {
    return std::ranges::find(people, person.id, &PersonView::id) == people.end();
  };
  std::erase_if(people_, is_gone);
  for (std::size_t i = 0; i < people.size(); ++i) {
    if (i == people_.size()) people_.push_back({.id = people[i].id, .since_ns = SteadyNs()});
    FollowedPerson& person = people_[i];
    const CaptureResult& result = people[i].capture->result();
    person.name = people[i].name;
    person.certainty = people[i].certainty;
    person.state = result.state;
    person.torso_W = result.points_W.col(static_cast<int>(Point::kTorso));
    person.residual_mm = result.residual_mm;
    person.sizes = people[i].capture->body().sizes();
  }
}

std::vector<FollowedPerson> LiveView::people() const {
  const std::scoped_lock lock(mutex_);
  return people_;
}

Fit LiveView::fit() const {
  return {std::max(0.0, residual_mm_.load(std::memory_order_relaxed)),
          voxels_.load(std::memory_order_relaxed)};
}

std::string LiveView::Line(const StatusReport& report) const {
  const auto millimetres = [](double value) {
    return value == kUnknown ? std::string("-") : fmt::format("{:.0f} mm", value);
  };
  const CaptureState state = state_.load(std::memory_order_relaxed);
  std::string line = fmt::format("{:<9}  {:4.1f} sets/s  latency {:3.0f} ms  residual {}  {}",
                                 kCaptureStateNames[static_cast<std::size_t>(state)],
                                 report.sets_per_second, report.recent[Stage::kLatency].p50_ms,
                                 millimetres(residual_mm_.load(std::memory_order_relaxed)),
                                 Counted(voxels_.load(std::memory_order_relaxed), "voxel"));
  if (const int people = count_.load(std::memory_order_relaxed); people > 1) {
    line += fmt::format("  {} people", people);
  }
  if (error_) {
    line += "  error " + millimetres(error_mm_.load(std::memory_order_relaxed));
  }
  return line;
}

}  // namespace mocap
