// Search for the least value of a function of one number.
#pragma once

#include <numbers>

namespace mocap {

/// Finds where a function with one minimum is least, by golden section (Kiefer 1953).
/// @param tolerance  length of the interval that remains.
template <typename Function>
double LeastBetween(double low, double high, double tolerance, const Function& function) {
  constexpr double kShare = 1 / std::numbers::phi;
  double left = high - kShare * (high - low), right = low + kShare * (high - low);
  double at_left = function(left), at_right = function(right);
  while (high - low > tolerance) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kShare * (high - low);
      at_left = function(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kShare * (high - low);
      at_right = function(right);
    }
  }
  return (low + high) / 2;
}

}  // namespace mocap
