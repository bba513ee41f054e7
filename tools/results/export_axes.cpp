#include "tools/results/export_axes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "core/errors.h"

namespace mocap {

EvenClock FitClock(const std::vector<PoseRow>& poses) {
  EvenClock clock;
  clock.steps.assign(poses.size(), 1);
  if (poses.size() < 2) return clock;
  std::vector<double> apart_s;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    apart_s.push_back(1e-9 *
                      static_cast<double>(poses[i].timestamp_ns - poses[i - 1].timestamp_ns));
  }
  std::vector<double> sorted = apart_s;
  std::ranges::sort(sorted);
  // If most frames are present, the median is the interval between neighbours.
  const double median_s = std::max(sorted[sorted.size() / 2], 1e-6);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    clock.steps[i] = std::max<std::int64_t>(1, std::llround(apart_s[i - 1] / median_s));
  }
  const double periods = std::accumulate(clock.steps.begin() + 1, clock.steps.end(), 0.0);
  clock.period_s = std::max(std::accumulate(apart_s.begin(), apart_s.end(), 0.0) / periods, 1e-6);
  return clock;
}

void RequireShortGap(std::int64_t missing, const PoseRow& row) {
  constexpr std::int64_t kLongest = 108'000;
  if (missing <= kLongest) return;
  throw SetupError("frame " + std::to_string(row.frame) + " comes " + std::to_string(missing) +
                   " frame times after the one before; at most " + std::to_string(kLongest) +
                   " missing ones are filled in");
}

}  // namespace mocap
