// Mean and standard deviation of what is measured at each stride.
#pragma once

#include <algorithm>
#include <cmath>

namespace mocap {

/// Of a sample; the deviation of fewer than two values is 0.
struct MeanAndSpread {
  int count = 0;
  double mean = 0, spread = 0;
};

/// Sums values for their mean and deviation.
class SampleSums {
 public:
  void Add(double value) {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  MeanAndSpread Measured() const {
    if (count_ == 0) return {};
    const double mean = sum_ / count_;
    const double rest = std::max(0.0, squares_ - sum_ * mean);
    return {count_, mean, count_ > 1 ? std::sqrt(rest / (count_ - 1)) : 0};
  }

 private:
  int count_ = 0;
  double sum_ = 0, squares_ = 0;
};

}  // namespace mocap
