#include "core/mikic2003/size_network.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace mocap::mikic2003 {
namespace {

// Standard deviations of Table 3 [mm]. Its weights β are in limbs.h.
constexpr double kTorsoMean = 500, kTorsoStd = 300;
constexpr double kProportionStd = 100;   // Thigh, Calf, UpperArm, LowerArm given Torso.
constexpr double kMeasurementStd = 200;  // Thm, Cm, UAm, LAm.
constexpr double kMemoryStd = 100;       // Thm0, Cm0, UAm0, LAm0.
constexpr double kHeightStd = 100;
constexpr double kSignificantChange = 1.1;

enum Node { kTorso = 0, kThigh, kCalf, kUpperArm, kLowerArm, kNodeCount };
using Lengths = Eigen::Matrix<double, kNodeCount, 1>;
constexpr std::array<double, kNodeCount> kPerTorso = {1, kThighPerTorso, kCalfPerTorso,
                                                      kUpperArmPerTorso, kLowerArmPerTorso};
constexpr std::array<SizeMember, kNodeCount> kMembers = {&BodySizes::torso, &BodySizes::thigh,
                                                         &BodySizes::calf, &BodySizes::upper_arm,
                                                         &BodySizes::lower_arm};

// The joint density of the five true lengths, in information form.
class Density {
 public:
  // Adds a factor: `value` is N(weights · lengths, std²).
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

std::optional<double> LengthOf(const MeasuredPoints& points, Point from, Point to) {
  if (!At(points, from) || !At(points, to)) return std::nullopt;
  return (*At(points, from) - *At(points, to)).norm();
}

}  // namespace

LengthMeasurements MeasureLengths(const MeasuredPoints& points, double height_less_head_mm) {
  LengthMeasurements lengths;
  const auto upper = [&](const Limb& limb) { return LengthOf(points, limb.root, limb.joint); };
  const auto lower = [&](const Limb& limb) { return LengthOf(points, limb.joint, limb.end); };
  lengths.upper_arm = MeanOf(upper(kLimbs[0]), upper(kLimbs[1]));
  lengths.lower_arm = MeanOf(lower(kLimbs[0]), lower(kLimbs[1]));
  lengths.thigh = MeanOf(upper(kLimbs[2]), upper(kLimbs[3]));
  lengths.calf = MeanOf(lower(kLimbs[2]), lower(kLimbs[3]));
  lengths.height = height_less_head_mm;
  return lengths;
}

double SizeNetwork::Update(LengthMeasurements measured, BodySizes& sizes) {
  if (measured.thigh && measured.calf) {
    const double sum_mm = sizes.torso + *measured.thigh + *measured.calf;
    if (sum_mm > kSignificantChange * measured.height) measured.height = sum_mm;
  }
  const std::array<std::optional<double>, kNodeCount> leaves = {
      std::nullopt, measured.thigh, measured.calf, measured.upper_arm, measured.lower_arm};
  Density density;
  density.Add(Lengths::Unit(kTorso), kTorsoMean, kTorsoStd);
  for (int node = kThigh; node < kNodeCount; ++node) {
    density.Add(Lengths::Unit(node) - kPerTorso[node] * Lengths::Unit(kTorso), 0, kProportionStd);
    if (leaves[node]) density.Add(Lengths::Unit(node), *leaves[node], kMeasurementStd);
    if (remembers_) density.Add(Lengths::Unit(node), sizes.*kMembers[node], kMemoryStd);
  }
  density.Add(Lengths::Unit(kTorso) + Lengths::Unit(kThigh) + Lengths::Unit(kCalf), measured.height,
              kHeightStd);
  remembers_ = true;

  const Lengths mean = density.Mean();
  double change_mm = 0;
  for (int node = kTorso; node < kNodeCount; ++node) {
    change_mm += mean[node] - sizes.*kMembers[node];
    sizes.*kMembers[node] = mean[node];
  }
  return std::abs(change_mm);
}

}  // namespace mocap::mikic2003
