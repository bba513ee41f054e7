#include "core/evaluation/precision.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.h"

namespace mocap {
namespace {

/// Row i computes the fitted polynomial at the window's position i from the window's values.
Eigen::MatrixXd ProjectionOntoPolynomials(int window, int order) {
  Eigen::MatrixXd powers(window, order + 1);
  // Positions from -1 to 1 keep the powers at the same magnitude.
  const Eigen::VectorXd place = Eigen::VectorXd::LinSpaced(window, -1, 1);
  powers.col(0).setOnes();
  for (int p = 1; p <= order; ++p) powers.col(p) = powers.col(p - 1).cwiseProduct(place);
  const Eigen::MatrixXd basis =
      powers.householderQr().householderQ() * Eigen::MatrixXd::Identity(window, order + 1);
  return basis * basis.transpose();
}

double MeanAbsoluteResidual(const Eigen::VectorXd& series, const SmoothingOptions& options) {
  return (series - SmoothSavitzkyGolay(series, options)).cwiseAbs().mean();
}

void AddRun(const std::vector<PoseSample>& run, const SmoothingOptions& options, Precision& sum) {
  const auto frames = static_cast<Eigen::Index>(run.size());
  Eigen::VectorXd angles(frames);
  for (int a = 0; a < kPaperAngleCount; ++a) {
    for (Eigen::Index i = 0; i < frames; ++i) angles[i] = run[i].paper.theta_rad[a];
    sum.angle_rad[a] += frames * MeanAbsoluteResidual(UnwrapAngles(angles), options);
  }
  Eigen::Matrix<double, Eigen::Dynamic, 3> path(frames, 3);
  for (int p = 0; p < kPointCount; ++p) {
    for (Eigen::Index i = 0; i < frames; ++i) path.row(i) = run[i].points_W.col(p).transpose();
    Eigen::Matrix<double, Eigen::Dynamic, 3> smooth(frames, 3);
    for (int axis = 0; axis < 3; ++axis) {
      smooth.col(axis) = SmoothSavitzkyGolay(path.col(axis), options);
    }
    sum.point_mm[p] += (path - smooth).rowwise().norm().sum();
  }
  sum.frames += static_cast<int>(frames);
}

}  // namespace

Eigen::VectorXd SmoothSavitzkyGolay(const Eigen::VectorXd& series,
                                    const SmoothingOptions& options) {
  MOCAP_CHECK(options.order >= 0 && options.half_window >= 0);
  const int length = static_cast<int>(series.size());
  if (length == 0) return series;
  const int window = std::min(length, 2 * options.half_window + 1);
  const Eigen::MatrixXd projection =
      ProjectionOntoPolynomials(window, std::min(options.order, window - 1));
  Eigen::VectorXd smooth(length);
  for (int i = 0; i < length; ++i) {
    const int first = std::clamp(i - options.half_window, 0, length - window);
    smooth[i] = projection.row(i - first).dot(series.segment(first, window));
  }
  return smooth;
}

Eigen::VectorXd UnwrapAngles(const Eigen::VectorXd& angles_rad) {
  Eigen::VectorXd unwrapped = angles_rad;
  for (Eigen::Index i = 1; i < unwrapped.size(); ++i) {
    const double step = std::remainder(unwrapped[i] - unwrapped[i - 1], 2 * std::numbers::pi);
    unwrapped[i] = unwrapped[i - 1] + step;
  }
  return unwrapped;
}

std::optional<Precision> MeasurePrecision(std::span<const std::vector<PoseSample>> runs,
                                          const SmoothingOptions& options) {
  const std::size_t window = 2 * options.half_window + 1;
  Precision result;
  for (const std::vector<PoseSample>& run : runs) {
    if (run.size() >= window) AddRun(run, options, result);
  }
  if (result.frames == 0) return std::nullopt;
  double without_twist = 0;
  for (int a = 0; a < kPaperAngleCount; ++a) {
    result.angle_rad[a] /= result.frames;
    result.mean_angle_rad += result.angle_rad[a] / kPaperAngleCount;
    // θ7 and θ8 turn the upper arms about their own axes.
    if (a != 6 && a != 7) without_twist += result.angle_rad[a];
  }
  result.mean_angle_without_twist_rad = without_twist / (kPaperAngleCount - 2);
  for (double& point_mm : result.point_mm) {
    point_mm /= result.frames;
    result.mean_point_mm += point_mm / kPointCount;
  }
  return result;
}

}  // namespace mocap
