// How often frame sets come.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "core/counted_time.h"
#include "core/quantile.h"

namespace mocap {

/// Tells gaps from the usual time between sets.
class SetRhythm {
 public:
  /// Adds the time since the last set, in seconds. Returns whether it is a gap: longer than counts,
  /// and than three times what was usual lately.
  bool IsGap(double interval_s) {
    std::array<double, kRemembered> sorted = intervals_s_;
    const std::size_t known = std::min(count_, kRemembered);
    const double usual_s = known > 0 ? MedianOf(std::span(sorted).first(known)) : 0;
    intervals_s_[count_++ % kRemembered] = interval_s;
    return interval_s > std::max(kMostCountedS, kLongerThanUsual * usual_s);
  }

 private:
  static constexpr std::size_t kRemembered = 9;
  static constexpr double kLongerThanUsual = 3;

  std::array<double, kRemembered> intervals_s_{};
  std::size_t count_ = 0;
};

}  // namespace mocap
