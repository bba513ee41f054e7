// §4: least squares for the last step of Tsai's calibration.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace mocap {

/// Residuals of a parameter vector. Their number never changes.
using ResidualFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct LeastSquaresResult {
  Eigen::VectorXd x;
  double cost = 0;  ///< Sum of squared residuals.
  int steps = 0;
  bool converged = false;
};

/// Minimizes the sum of squared residuals, starting from `start`.
///
/// Levenberg–Marquardt with derivatives by central differences, for a few dozen parameters.
/// @param scale  typical change of each parameter, all above 0. Derivatives are taken over a
/// millionth of it, and damping is in its units.
LeastSquaresResult MinimizeSquares(const ResidualFunction& residuals, const Eigen::VectorXd& start,
                                   const Eigen::VectorXd& scale, int most_steps = 200);

}  // namespace mocap
