#include "daemon/pipeline/pacer.h"

#include <algorithm>
#include <cmath>

namespace mocap {

Pacer::Pacer(double hz) : period_ns_(hz > 0 ? std::llround(1e9 / hz) : 0) {}

bool Pacer::IsDue(std::int64_t now_ns) {
  if (period_ns_ == 0 || now_ns < next_ns_) return false;
  // Keeps the phase, unless the due time is long past.
  next_ns_ = now_ns - next_ns_ < period_ns_ ? next_ns_ + period_ns_ : now_ns + period_ns_;
  return true;
}

}  // namespace mocap
