#include "core/objective/residual_noise.h"

#include <cmath>

namespace mocap {

double ResidualNoise::NatsAt(double residual_mm) const {
  return NatsOf(std::log1p(ScaledSquare(residual_mm)));
}

ResidualNoise ResidualNoise::Widened(double pose_std_mm) const {
  ResidualNoise wider = *this;
  wider.inside_mm = std::hypot(inside_mm, pose_std_mm);
  wider.outside_mm = std::hypot(outside_mm, pose_std_mm);
  return wider;
}

ResidualNoise ResidualNoise::Of(int residuals, double independent) const {
  ResidualNoise noise = *this;
  noise.alike = 1 + residuals / independent;
  return noise;
}

void LogSum::Take() {
  sum_ += std::log(product_);
  product_ = 1;
}

double LogSum::Sum() {
  Take();
  return sum_;
}

}  // namespace mocap
