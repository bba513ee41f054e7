#include "tools/comparison/rigid_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/quantile.h"

namespace mocap {
namespace {

/// Of a normal distribution: the standard deviation over the median absolute value of three
/// coordinates' length.
constexpr double kDeviationOverMedian = 1 / 1.5382;
/// Cauchy's loss with this multiple of the standard deviation is 95 % efficient (Holland and Welsch
/// 1977).
constexpr double kCauchy = 2.385;
/// Closer than this, nothing is an outlier: no recording is more exact [mm].
constexpr double kFinest_mm = 0.05;

std::vector<double> DistancesOf(std::span<const PlacePair> pairs, const RigidTransform& X) {
  std::vector<double> distances;
  distances.reserve(pairs.size());
  for (const PlacePair& pair : pairs) distances.push_back((X * pair.other - pair.own).norm());
  return distances;
}

}  // namespace

double RobustScale(double median_mm) {
  return std::max(kFinest_mm, kDeviationOverMedian * median_mm);
}

double CauchyWeight(double distance_mm, double scale_mm) {
  const double share = distance_mm / (kCauchy * scale_mm);
  return 1 / (1 + share * share);
}

std::optional<RigidTransform> FitRigid(std::span<const PlacePair> pairs,
                                       std::span<const double> weights) {
  if (pairs.size() < 3) return {};
  const auto weight = [&](std::size_t i) { return weights.empty() ? 1.0 : weights[i]; };
  double sum = 0;
  Vector3 other = Vector3::Zero(), own = Vector3::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    sum += weight(i);
    other += weight(i) * pairs[i].other;
    own += weight(i) * pairs[i].own;
  }
  if (!(sum > 0)) return {};
  other /= sum;
  own /= sum;
  Matrix3 covariance = Matrix3::Zero();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    covariance += weight(i) * (pairs[i].own - own) * (pairs[i].other - other).transpose();
  }
  const Eigen::JacobiSVD<Matrix3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  constexpr double kFlattest = 1e-6;
  if (!(svd.singularValues()[1] > kFlattest * svd.singularValues()[0])) return {};
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Matrix3 R = svd.matrixU() * Vector3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  return RigidTransform{R, own - R * other};
}

std::optional<RigidFit> FitRobustly(std::span<const PlacePair> pairs, const RigidTransform* start,
                                    int iterations) {
  if (pairs.empty()) return {};
  std::optional<RigidTransform> X = start ? *start : FitRigid(pairs);
  RigidFit fit;
  std::vector<double> weights(pairs.size());
  for (int i = 0; X; ++i) {
    const std::vector<double> distances = DistancesOf(pairs, *X);
    std::vector<double> sorted = distances;
    fit = {*X, MedianOf(sorted)};
    if (i == iterations) return fit;
    const double scale_mm = RobustScale(fit.median_mm);
    for (std::size_t k = 0; k < pairs.size(); ++k)
      weights[k] = CauchyWeight(distances[k], scale_mm);
    X = FitRigid(pairs, weights);
  }
  return {};
}

}  // namespace mocap
