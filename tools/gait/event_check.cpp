#include "tools/gait/event_check.h"

#include <cmath>
#include <optional>
#include <vector>

namespace mocap {
namespace {

/// How much later the nearest event of the same side and kind is; empty if none is near.
std::optional<double> LatenessOf(const GaitEvent& event, std::span<const GaitEvent> others) {
  std::optional<double> nearest_s;
  for (const GaitEvent& other : others) {
    if (other.side != event.side || other.kind != event.kind) continue;
    const double later_s = other.time_s - event.time_s;
    if (std::abs(later_s) < std::abs(nearest_s.value_or(kSameEvent_s))) nearest_s = later_s;
  }
  return nearest_s;
}

}  // namespace

EventCheck CompareEvents(std::span<const GaitEvent> by_contact,
                         std::span<const GaitEvent> by_position) {
  EventCheck check;
  std::array<SampleSums, kGaitEventNames.size()> later_s;
  for (const GaitEvent& event : by_position)
    ++check[static_cast<std::size_t>(event.kind)].by_position;
  for (const GaitEvent& event : by_contact) {
    const auto kind = static_cast<std::size_t>(event.kind);
    ++check[kind].by_contact;
    if (const std::optional<double> later = LatenessOf(event, by_position))
      later_s[kind].Add(*later);
  }
  for (std::size_t kind = 0; kind < check.size(); ++kind)
    check[kind].later_s = later_s[kind].Measured();
  return check;
}

}  // namespace mocap
