#include "core/acquisition/body_size_network.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace mocap {
namespace {

enum Node { kTorso = 0, kThigh, kCalf, kUpperArm, kLowerArm, kNodeCount };
using Lengths = Eigen::Matrix<double, kNodeCount, 1>;

// The joint density of the five hidden lengths in information form.
class Density {
 public:
  // Adds the factor value = weights · lengths + N(0, std²).
  void Add(const Lengths& weights, double value, double std_mm) {
    information_ += weights * weights.transpose() / (std_mm * std_mm);
    vector_ += weights * (value / (std_mm * std_mm));
  }
  Lengths Mean() const { return information_.llt().solve(vector_); }

 private:
  Eigen::Matrix<double, kNodeCount, kNodeCount> information_ =
      Eigen::Matrix<double, kNodeCount, kNodeCount>::Zero();
  Lengths vector_ = Lengths::Zero();
};

}  // namespace

double BodySizeNetwork::Update(const LengthMeasurements& measured, bool remember,
                               BodySizes& sizes) const {
  const BodyProportions& p = proportions_;
  const std::array<Proportion, kNodeCount> of_torso = {Proportion{}, p.thigh, p.calf, p.upper_arm,
                                                       p.lower_arm};
  const std::array<std::optional<double>, kNodeCount> leaf = {
      std::nullopt, measured.thigh, measured.calf, measured.upper_arm, measured.lower_arm};
  const std::array<double*, kNodeCount> length = {&sizes.torso, &sizes.thigh, &sizes.calf,
                                                  &sizes.upper_arm, &sizes.lower_arm};
  Density density;
  density.Add(Lengths::Unit(kTorso), p.torso_mean_mm, p.torso_std_mm);
  for (int node = kThigh; node < kNodeCount; ++node) {
    density.Add(Lengths::Unit(node) - of_torso[node].weight * Lengths::Unit(kTorso), 0,
                of_torso[node].std_mm);
    if (leaf[node]) density.Add(Lengths::Unit(node), *leaf[node], p.measurement_std_mm);
    if (remember) density.Add(Lengths::Unit(node), *length[node], p.memory_std_mm);
  }
  if (measured.height) {
    density.Add(Lengths::Unit(kTorso) + Lengths::Unit(kThigh) + Lengths::Unit(kCalf),
                *measured.height, p.height_std_mm);
  }

  const Lengths mean = density.Mean();
  double change_mm = 0;
  for (int node = kTorso; node < kNodeCount; ++node) {
    change_mm += std::abs(mean[node] - *length[node]);
    *length[node] = mean[node];
  }
  return change_mm;
}

}  // namespace mocap
