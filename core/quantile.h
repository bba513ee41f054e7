// Order statistics.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace mocap {

/// Returns the value below which this share of the values lies, without interpolation; reorders
/// them.
/// @pre  `values` is not empty; `share` is from 0 to 1.
inline double QuantileOf(std::span<double> values, double share) {
  const auto rank =
      static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::ranges::nth_element(values, values.begin() + rank);
  return values[static_cast<std::size_t>(rank)];
}

inline double MedianOf(std::span<double> values) { return QuantileOf(values, 0.5); }

/// Ratio of the standard deviation to the median of the absolute values, for a normal distribution
/// about 0.
inline constexpr double kDeviationPerMedian = 1.4826;

}  // namespace mocap
