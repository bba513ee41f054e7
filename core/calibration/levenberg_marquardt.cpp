#include "core/calibration/levenberg_marquardt.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr double kDerivativeStep = 1e-6;
constexpr double kLeastDamping = 1e-12;
constexpr double kMostDamping = 1e12;

// Computes derivatives by parameters, in units of their scale.
Eigen::MatrixXd Jacobian(const ResidualFunction& residuals, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& scale, Eigen::Index rows) {
  Eigen::MatrixXd J(rows, x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double h = kDerivativeStep * scale[i];
    Eigen::VectorXd above = x, below = x;
    above[i] += h;
    below[i] -= h;
    J.col(i) = (residuals(above) - residuals(below)) * (scale[i] / (above[i] - below[i]));
  }
  return J;
}

}  // namespace

LeastSquaresResult MinimizeSquares(const ResidualFunction& residuals, const Eigen::VectorXd& start,
                                   const Eigen::VectorXd& scale, int most_steps) {
  MOCAP_CHECK(start.size() == scale.size() && scale.minCoeff() > 0);
  LeastSquaresResult result;
  result.x = start;
  Eigen::VectorXd r = residuals(start);
  result.cost = r.squaredNorm();
  double damping = 1e-3;
  while (result.steps < most_steps && !result.converged) {
    ++result.steps;
    const Eigen::MatrixXd J = Jacobian(residuals, result.x, scale, r.size());
    const Eigen::MatrixXd H = J.transpose() * J;
    const Eigen::VectorXd g = J.transpose() * r;
    bool lower = false;
    while (!lower && damping < kMostDamping) {
      Eigen::MatrixXd damped = H;
      damped.diagonal() *= 1 + damping;
      damped.diagonal().array() += 1e-300;
      const Eigen::VectorXd step = -damped.ldlt().solve(g).cwiseProduct(scale);
      const Eigen::VectorXd next = result.x + step;
      const Eigen::VectorXd next_r = residuals(next);
      const double next_cost = next_r.squaredNorm();
      lower = std::isfinite(next_cost) && next_cost < result.cost;
      if (!lower) {
        damping *= 10;
        continue;
      }
      result.converged = result.cost - next_cost <= 1e-14 * result.cost;
      result.x = next;
      result.cost = next_cost;
      r = next_r;
      damping = std::max(kLeastDamping, damping / 10);
    }
    // No step of any length reduces the cost: this is the minimum.
    if (!lower) result.converged = true;
  }
  return result;
}

}  // namespace mocap
