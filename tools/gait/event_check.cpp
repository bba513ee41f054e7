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
  std::array<double, 2> sums_s{}, squares_s2{};
  for (const GaitEvent& event : by_position)
    ++check[static_cast<std::size_t>(event.kind)].by_position;
  for (const GaitEvent& event : by_contact) {
    const auto kind = static_cast<std::size_t>(event.kind);
    ++check[kind].by_contact;
    const std::optional<double> later_s = LatenessOf(event, by_position);
    if (!later_s) continue;
    ++check[kind].both;
    sums_s[kind] += *later_s;
    squares_s2[kind] += *later_s * *later_s;
  }
  for (std::size_t kind = 0; kind < check.size(); ++kind) {
    EventAgreement& one = check[kind];
    if (one.both == 0) continue;
    one.mean_s = sums_s[kind] / one.both;
    const double rest_s2 = squares_s2[kind] - sums_s[kind] * one.mean_s;
    if (one.both > 1) one.spread_s = std::sqrt(std::max(0.0, rest_s2) / (one.both - 1));
  }
  return check;
}

}  // namespace mocap
