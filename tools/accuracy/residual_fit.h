// Fits the noise of residuals.
#pragma once

#include <vector>

#include "core/objective/residual_noise.h"

namespace mocap {

/// What is known of some residuals.
struct Residuals {
  std::vector<float> mm;
  /// So many others are known only to be from 0 to `least_mm`. If there are any, all are positive.
  double small = 0;
  double least_mm = 0;

  double count() const { return small + static_cast<double>(mm.size()); }
};

/// Fits degrees of freedom and both scales of a two-piece Student's t by maximum likelihood. Its
/// density is 2 / (a + b) t(r / s), where s is a inside of the surface and b outside.
///
/// If all residuals are on one side, the other side's scale is 0, and the density is half a t.
/// @param residuals  some, none of them 0.
ResidualNoise FitResiduals(const Residuals& residuals);

/// Mean -log p of residuals by that density [nats].
double MeanNats(const Residuals& residuals, const ResidualNoise& noise);

}  // namespace mocap
