// How residuals of the evidence are spread about the body.
#pragma once

namespace mocap {

/// Noise of one kind of evidence, measured at true poses (`mocap benchmark --parts noise`).
///
/// Residuals follow Student's t, whose tails allow for outliers (Lange, Little and Taylor 1989),
/// with one scale inside of the surface and another outside (Fernández and Steel 1998): cloth hangs
/// off the flesh and never cuts into it. With degrees of freedom v and scale s of its side, a
/// residual r costs
///     (v + 1) / (2 alike) log(1 + r² / (v s²))  nats
/// more than one of 0. The derivative is r times a weight, and iterated least squares with these
/// weights descends what comparisons compare.
struct ResidualNoise {
  double freedom = 1;
  double inside_mm = 1;   ///< Scale of negative residuals.
  double outside_mm = 1;  ///< Scale of positive residuals.
  /// Neighbours err alike: this many residuals count as one.
  double alike = 1;

  double ScaledSquare(double residual_mm) const {
    const double scale_mm = residual_mm < 0 ? inside_mm : outside_mm;
    return residual_mm * residual_mm / (freedom * scale_mm * scale_mm);
  }
  /// Cost of a sum of log(1 + ScaledSquare) [nats].
  double NatsOf(double sum_of_logs) const { return (freedom + 1) / (2 * alike) * sum_of_logs; }
  double NatsAt(double residual_mm) const;
  /// Variance that gives the residual its weight in least squares [mm²].
  double VarianceAt(double residual_mm) const {
    const double scale_mm = residual_mm < 0 ? inside_mm : outside_mm;
    return alike * scale_mm * scale_mm * freedom / (freedom + 1) * (1 + ScaledSquare(residual_mm));
  }

  /// The same noise about a pose that is uncertain by a standard deviation.
  ResidualNoise Widened(double pose_std_mm) const;
  /// The same noise of this many residuals, if no number of them counts as more than `independent`.
  ResidualNoise Of(int residuals, double independent) const;
};

/// Sums log(1 + x) of many numbers, as logarithms of products.
class LogSum {
 public:
  void Add(double scaled_square) {
    product_ *= 1 + scaled_square;
    if (product_ > kLarge) Take();
  }
  double Sum();

 private:
  static constexpr double kLarge = 1e150;
  void Take();

  double product_ = 1, sum_ = 0;
};

}  // namespace mocap
