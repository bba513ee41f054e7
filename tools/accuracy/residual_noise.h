// How residuals of the evidence are spread: normal, or an outlier anywhere within reach.
#pragma once

namespace mocap {

/// Noise of one kind of evidence, as measured at true poses (`mocap benchmark --parts noise`).
///
/// A residual r is normal with a standard deviation, or an outlier that is spread evenly:
/// p(r) = (1 - e) N(r; 0, s²) + e / reach.
struct ResidualNoise {
  double sigma_mm = 0;
  double outlier_share = 0;
  double reach_mm = 0;  ///< Length of the interval that outliers fall in.
  /// Neighbours err alike: this share of the residuals would say as much if they were independent.
  double independent_share = 1;

  /// -log p of a residual [nats].
  double Nats(double residual_mm) const;
  /// Probability that a residual is not an outlier.
  double Inlier(double residual_mm) const;
};

}  // namespace mocap
