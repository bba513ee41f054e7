#include "tools/accuracy/residual_noise.h"

#include <cmath>
#include <numbers>

namespace mocap {
namespace {

// Density of the normal part and of the outliers [1/mm].
struct Densities {
  double normal, outlier;
};

Densities DensitiesOf(const ResidualNoise& noise, double residual_mm) {
  const double scaled = residual_mm / noise.sigma_mm;
  const double peak = 1 / (noise.sigma_mm * std::sqrt(2 * std::numbers::pi));
  return {(1 - noise.outlier_share) * peak * std::exp(-scaled * scaled / 2),
          noise.outlier_share / noise.reach_mm};
}

}  // namespace

double ResidualNoise::Nats(double residual_mm) const {
  const auto [normal, outlier] = DensitiesOf(*this, residual_mm);
  return -std::log(normal + outlier);
}

double ResidualNoise::Inlier(double residual_mm) const {
  const auto [normal, outlier] = DensitiesOf(*this, residual_mm);
  return normal / (normal + outlier);
}

}  // namespace mocap
