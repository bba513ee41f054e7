#include "daemon/period_estimator.h"

#include <algorithm>

namespace mocap {

void PeriodEstimator::Add(std::int64_t capture_ns) {
  if (count_ > 0) intervals_[(count_ - 1) % kIntervals] = capture_ns - last_ns_;
  last_ns_ = capture_ns;
  ++count_;
  const std::size_t known = std::min(count_ - 1, kIntervals);
  if (known == 0) return;
  std::array<std::int64_t, kIntervals> sorted = intervals_;
  const auto quartile = sorted.begin() + known / 4;
  std::nth_element(sorted.begin(), quartile, sorted.begin() + known);
  period_ns_ = *quartile;
}

}  // namespace mocap
