#include "tools/comparison/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocap {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Sums of two curves where both are known.
struct CurveSums {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0, apart = 0;

  CurveSums(std::span<const double> first, std::span<const double> second) {
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
      const double x = first[i], y = second[i];
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      ++n;
      a += x;
      b += y;
      aa += x * x;
      bb += y * y;
      ab += x * y;
      apart += (x - y) * (x - y);
    }
  }
};

}  // namespace

Agreement AgreementOf(std::span<const double> differences) {
  double sum = 0, squares = 0;
  std::size_t count = 0;
  for (const double difference : differences) {
    if (!std::isfinite(difference)) continue;
    sum += difference;
    squares += difference * difference;
    ++count;
  }
  if (count == 0) return {0, kNone, kNone, kNone, kNone, kNone, kNone};
  const auto n = static_cast<double>(count);
  Agreement agreement{count, sum / n, 0, 0, 0, std::sqrt(squares / n), 0};
  double apart = 0;
  for (const double difference : differences)
    if (std::isfinite(difference)) apart += std::pow(difference - agreement.bias, 2);
  agreement.rmsd_without_bias = std::sqrt(apart / n);
  agreement.deviation = count > 1 ? std::sqrt(apart / (n - 1)) : kNone;
  constexpr double kOf95Percent = 1.96;
  agreement.lower = agreement.bias - kOf95Percent * agreement.deviation;
  agreement.upper = agreement.bias + kOf95Percent * agreement.deviation;
  return agreement;
}

double CorrelationOf(std::span<const double> a, std::span<const double> b) {
  const CurveSums sums(a, b);
  if (sums.n < 3) return kNone;
  const double var_a = sums.aa - sums.a * sums.a / sums.n;
  const double var_b = sums.bb - sums.b * sums.b / sums.n;
  constexpr double kRounding = 1e-12;
  if (!(var_a > kRounding * sums.aa) || !(var_b > kRounding * sums.bb)) return kNone;
  return std::clamp((sums.ab - sums.a * sums.b / sums.n) / std::sqrt(var_a * var_b), -1.0, 1.0);
}

double MultipleCorrelationOf(std::span<const double> a, std::span<const double> b) {
  const CurveSums sums(a, b);
  if (sums.n < 3) return kNone;
  // Both curves vary around their mean at each moment by half of their squared difference; and
  // around the mean of all by the rest.
  const double within = sums.apart / 2 / sums.n;
  const double mean = (sums.a + sums.b) / (2 * sums.n);
  const double total = (sums.aa + sums.bb - 2 * sums.n * mean * mean) / (2 * sums.n - 1);
  if (!(total > 0) || within > total) return kNone;
  return std::sqrt(1 - within / total);
}

}  // namespace mocap
