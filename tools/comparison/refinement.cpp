#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/quantile.h"
#include "tools/comparison/alignment.h"
#include "tools/comparison/least_near.h"

namespace mocap {
namespace {

constexpr std::size_t kManyMoments = 1500;
/// Iterations of robust fits: from least squares, and from a transform nearby.
constexpr int kFittings = 20, kFewFittings = 3;

/// Differences without the constant part in the axes of each pair's segment.
std::vector<Vector3> WithoutMeans(const ResultMotion& own, const Alignment& alignment,
                                  const PairedPlaces& all, std::vector<Vector3> vectors_W) {
  const std::vector<Vector3> means = SegmentMeans(own, alignment, all, vectors_W);
  for (std::size_t i = 0; i < vectors_W.size(); ++i)
    vectors_W[i] -= RotationAt(own, alignment, all, i) * means[all.pair[i]];
  return vectors_W;
}

std::vector<Vector3> DifferencesOf(const Alignment& alignment, const PairedPlaces& all) {
  std::vector<Vector3> differences;
  for (const PlacePair& place : all.places)
    differences.push_back(place.own - alignment.X * place.other);
  return differences;
}

/// Mean of Cauchy's loss of differences without their constant part.
double LossOf(const ResultMotion& own, const Alignment& alignment, const PairedPlaces& all,
              double scale_mm) {
  double loss = 0;
  for (const Vector3& apart : WithoutMeans(own, alignment, all, DifferencesOf(alignment, all)))
    loss += std::log1p(apart.squaredNorm() / (scale_mm * scale_mm));
  // What leaves no overlap is no better than outliers.
  return all.places.empty() ? 1e9 : loss / static_cast<double>(all.places.size());
}

double MedianLength(const std::vector<Vector3>& vectors) {
  std::vector<double> lengths;
  for (const Vector3& vector : vectors) lengths.push_back(vector.norm());
  return lengths.empty() ? kUnmeasured : MedianOf(lengths);
}

/// How much later our motion is than the offset says: one step of Gauss-Newton's method [s].
///
/// Differences are explained by our points' velocities, a small turn and a shift. Velocities come
/// from the frames before and after, so that noise does not move the step's zero: the least sum of
/// squares between frames would lie where interpolation smooths the most.
double StepOf(const ResultMotion& own, const Alignment& alignment, const PairedPlaces& all) {
  const std::vector<Vector3> apart =
      WithoutMeans(own, alignment, all, DifferencesOf(alignment, all));
  const std::vector<Vector3> velocity = WithoutMeans(own, alignment, all, all.velocity_W);
  const double scale_mm = RobustScale(MedianLength(apart));
  using Matrix7 = Eigen::Matrix<double, 7, 7>;
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  Matrix7 normal = Matrix7::Zero();
  Vector7 right = Vector7::Zero();
  for (std::size_t i = 0; i < apart.size(); ++i) {
    if (!velocity[i].allFinite()) continue;
    Eigen::Matrix<double, 3, 7> J;
    // Turns in milliradians move points a metre away as far as shifts in millimetres do.
    J << velocity[i], 1e-3 * Hat(all.places[i].own - all.places[0].own), Matrix3::Identity();
    const double weight = CauchyWeight(apart[i].norm(), scale_mm);
    normal += weight * J.transpose() * J;
    right += weight * J.transpose() * apart[i];
  }
  // Somebody who stands still has no time.
  normal(0, 0) += 1;
  const Vector7 step = normal.ldlt().solve(right);
  return step.allFinite() ? step[0] : 0;
}

/// @param start  null: least squares.
void FitTransform(const PairedPlaces& all, const RigidTransform* start, int iterations,
                  Alignment& alignment) {
  const auto fit = FitRobustly(all.places, start, iterations);
  if (!fit) return;
  alignment.X = fit->X;
  alignment.median_mm = fit->median_mm;
}

}  // namespace

Alignment Refined(const ResultMotion& own, const RecordedMotion& other, Alignment alignment,
                  double reach_s) {
  constexpr double kNear_s = 1e-3, kExact_s = 1e-6;
  constexpr int kMostSteps = 12;
  const PairedPlaces start = PlacesAt(own, other, alignment, kManyMoments);
  const double scale_mm = RobustScale(
      MedianLength(WithoutMeans(own, alignment, start, DifferencesOf(alignment, start))));
  alignment.offset_s = LeastNear(alignment.offset_s, reach_s, kNear_s, [&](double offset_s) {
    Alignment trial = alignment;
    trial.offset_s = offset_s;
    PairedPlaces all = PlacesAt(own, other, trial, kManyMoments);
    if (const auto fit = FitRobustly(all.places, &trial.X, kFewFittings)) trial.X = fit->X;
    return LossOf(own, trial, all, scale_mm);
  });
  const auto places = [&] { return PlacesAt(own, other, alignment, kManyMoments); };
  FitTransform(places(), nullptr, kFittings, alignment);
  for (int i = 0; i < kMostSteps; ++i) {
    const PairedPlaces all = places();
    // Our motion at a moment is the other's at an earlier one: what is ahead must be put off.
    const double step_s = std::clamp(StepOf(own, alignment, all), -reach_s, reach_s);
    alignment.offset_s -= step_s;
    if (std::abs(step_s) < kExact_s) break;
    const RigidTransform start_X = alignment.X;
    FitTransform(places(), &start_X, kFewFittings, alignment);
  }
  FitTransform(places(), nullptr, kFittings, alignment);
  return alignment;
}

}  // namespace mocap
