#include "core/evaluation/jitter.h"

namespace mocap {

std::optional<double> MeanThirdDifference_mm(std::span<const std::vector<ScoredPoints>> runs) {
  double sum_mm = 0;
  int count = 0;
  for (const std::vector<ScoredPoints>& run : runs) {
    for (std::size_t i = 3; i < run.size(); ++i) {
      const ScoredPoints difference = run[i] - 3 * run[i - 1] + 3 * run[i - 2] - run[i - 3];
      sum_mm += difference.colwise().norm().mean();
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum_mm / count;
}

}  // namespace mocap
