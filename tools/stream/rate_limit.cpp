#include "tools/stream/rate_limit.h"

#include <algorithm>

namespace mocap {

bool RateLimit::Passes(std::int64_t time_ns) {
  const double since_s = 1e-9 * static_cast<double>(time_ns - before_ns_);
  before_ns_ = time_ns;
  // Tolerates a thousandth: a period in nanoseconds is rounded.
  constexpr double kTurn = 0.999;
  saved_ = std::min(kMostSaved, saved_ + hz_ * std::max(since_s, 1e-9));
  if (saved_ < kTurn) return false;
  saved_ = std::max(0.0, saved_ - 1);
  return true;
}

}  // namespace mocap
