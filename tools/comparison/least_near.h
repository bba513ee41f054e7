// Search for the least value of a function near a start.
#pragma once

#include "tools/accuracy/golden_section.h"

namespace mocap {

/// Finds where a function is least, near a start: first by a scan, then by the golden section.
template <typename Function>
double LeastNear(double start, double reach, double tolerance, const Function& loss) {
  constexpr int kScan = 4;
  const double step = reach / kScan;
  double best = start, least = loss(start);
  for (int i = -kScan; i <= kScan; ++i) {
    const double at = start + i * step, value = i == 0 ? least : loss(at);
    if (value >= least) continue;
    least = value;
    best = at;
  }
  const double middle = LeastBetween(best - step, best + step, tolerance, loss);
  // A start that is exact stays so.
  return loss(middle) < least ? middle : best;
}

}  // namespace mocap
