#include "daemon/nodes/node_clock.h"

#include <algorithm>

namespace mocap {
namespace {

constexpr std::int64_t kWindowNs = 500'000'000;

}  // namespace

bool NodeClock::Take(std::int64_t transit_ns, std::int64_t set_ns, std::int64_t now_ns) {
  if (set_ns_ && *set_ns_ != set_ns) {
    least_ns_ = least_before_ns_ = kNone;
    settled_ns_ = now_ns + kWindowNs;
  }
  set_ns_ = set_ns;
  const std::int64_t age_ns = now_ns - window_begin_ns_;
  if (least_ns_ == kNone || age_ns >= kWindowNs) {
    least_before_ns_ = age_ns < 2 * kWindowNs ? least_ns_ : kNone;
    least_ns_ = kNone;
    window_begin_ns_ = now_ns;
  }
  least_ns_ = std::min(least_ns_, transit_ns);
  return agrees() && transit_ns < kStaleNs && now_ns >= settled_ns_;
}

std::int64_t NodeClock::apart_ns() const {
  const std::int64_t least_ns = std::min(least_ns_, least_before_ns_);
  return least_ns == kNone ? 0 : least_ns;
}

}  // namespace mocap
