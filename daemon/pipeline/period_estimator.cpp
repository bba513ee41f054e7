#include "daemon/pipeline/period_estimator.h"

#include <algorithm>

namespace mocap {

void PeriodEstimator::Add(std::int64_t capture_ns, std::uint64_t sequence) {
  if (count_ > 0) {
    const auto frames =
        sequence > last_sequence_ ? static_cast<std::int64_t>(sequence - last_sequence_) : 1;
    intervals_[(count_ - 1) % kIntervals] = (capture_ns - last_ns_) / frames;
  }
  last_ns_ = capture_ns;
  last_sequence_ = sequence;
  ++count_;
  const std::size_t known = std::min(count_ - 1, kIntervals);
  if (known == 0) return;
  std::array<std::int64_t, kIntervals> sorted = intervals_;
  const auto quartile = sorted.begin() + known / 4;
  std::nth_element(sorted.begin(), quartile, sorted.begin() + known);
  period_ns_ = *quartile;
}

}  // namespace mocap
