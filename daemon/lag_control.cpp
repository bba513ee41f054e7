#include "daemon/lag_control.h"

#include <algorithm>

namespace mocap {

void LagControl::Add(std::int64_t capture_ns, std::int64_t arrival_ns, std::int64_t now_ns,
                     std::int64_t period_ns) {
  least_delay_ns_ = std::min(least_delay_ns_, arrival_ns - capture_ns);
  const std::int64_t lag_ns = now_ns - capture_ns - least_delay_ns_;
  if (lag_ns <= kTolerancePeriods * period_ns) return;
  const std::int64_t left_out = lag_ns / period_ns - kTargetPeriods;
  skipped_ += left_out;
  wanted_from_ns_ = capture_ns + left_out * period_ns + period_ns / 2;
}

}  // namespace mocap
