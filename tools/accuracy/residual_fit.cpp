#include "tools/accuracy/residual_fit.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numbers>

#include "tools/accuracy/golden_section.h"

namespace mocap {
namespace {

constexpr double kFirstScale_mm = 15;
constexpr double kLeastFreedom = 0.3, kMostFreedom = 100;
constexpr double kLeastScale_mm = 1e-3, kMostScale_mm = 1e3;
constexpr double kLogTolerance = 0.005;
constexpr int kMostRounds = 300;
constexpr double kScaleTolerance = 1e-5;  // Change in a round, as a share.

// One round of expectation maximization (Lange, Little and Taylor 1989). With weighted squares A
// and B of the two sides, n log(a + b) + A / 2a² + B / 2b² is least where a³ : b³ = A : B.
void ImproveScales(const Residuals& residuals, ResidualNoise& noise) {
  double inside = 0, outside = 0;
  for (const double r : residuals.mm) {
    const double weight = (1 + 1 / noise.freedom) / (1 + noise.ScaledSquare(r));
    (r < 0 ? inside : outside) += weight * r * r;
  }
  const double a = std::cbrt(inside), b = std::cbrt(outside);
  const double common = std::sqrt((a + b) / residuals.count());
  noise.inside_mm = a * common;
  noise.outside_mm = b * common;
}

void FitScales(const Residuals& residuals, ResidualNoise& noise) {
  if (residuals.small > 0) {
    noise.inside_mm = 0;
    const auto nats = [&](double log_scale) {
      noise.outside_mm = std::exp(log_scale);
      return MeanNats(residuals, noise);
    };
    nats(LeastBetween(std::log(kLeastScale_mm), std::log(kMostScale_mm), kLogTolerance, nats));
    return;
  }
  for (int round = 0; round < kMostRounds; ++round) {
    const ResidualNoise before = noise;
    ImproveScales(residuals, noise);
    const double change_mm = std::abs(noise.inside_mm - before.inside_mm) +
                             std::abs(noise.outside_mm - before.outside_mm);
    if (change_mm < kScaleTolerance * (noise.inside_mm + noise.outside_mm)) return;
  }
}

// -log p of a residual of 0.
double NatsOfNone(const ResidualNoise& noise) {
  const double v = noise.freedom;
  return std::log((noise.inside_mm + noise.outside_mm) / 2) + std::lgamma(v / 2) -
         std::lgamma((v + 1) / 2) + std::log(v * std::numbers::pi) / 2;
}

}  // namespace

ResidualNoise FitResiduals(const Residuals& residuals) {
  ResidualNoise noise{.inside_mm = kFirstScale_mm, .outside_mm = kFirstScale_mm};
  const auto fit = [&](double log_freedom) {
    noise.freedom = std::exp(log_freedom);
    FitScales(residuals, noise);
    return MeanNats(residuals, noise);
  };
  fit(LeastBetween(std::log(kLeastFreedom), std::log(kMostFreedom), kLogTolerance, fit));
  return noise;
}

double MeanNats(const Residuals& residuals, const ResidualNoise& noise) {
  LogSum logs;
  for (const double r : residuals.mm) logs.Add(noise.ScaledSquare(r));
  double sum = static_cast<double>(residuals.mm.size()) * NatsOfNone(noise) +
               noise.NatsOf(logs.Sum()) * noise.alike;
  if (residuals.small > 0) {
    const boost::math::students_t t(noise.freedom);
    sum -= residuals.small * std::log(1 - 2 * cdf(t, -residuals.least_mm / noise.outside_mm));
  }
  return sum / residuals.count();
}

}  // namespace mocap
