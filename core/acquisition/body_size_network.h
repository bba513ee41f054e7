// §7.2: the Bayesian network that turns measured part lengths into believable ones.
#pragma once

#include <optional>

#include "core/body/body_sizes.h"

namespace mocap {

/// A linear Gaussian: child = weight · parent + noise.
struct Proportion {
  double weight = 1;
  double std_mm = 100;
};

/// The network's parameters; the default is the paper's Table 3.
struct BodyProportions {
  double torso_mean_mm = 500;
  double torso_std_mm = 300;
  Proportion thigh{0.9, 100};
  Proportion calf{1.0, 100};
  Proportion upper_arm{0.55, 100};
  Proportion lower_arm{0.75, 100};
  double height_std_mm = 100;       ///< Height = thigh + calf + torso.
  double measurement_std_mm = 200;  ///< Thm, Cm, UAm, LAm.
  double memory_std_mm = 100;       ///< Thm0, Cm0, UAm0, LAm0.
};

/// Lengths of parts [mm]; left and right averaged. What was not measured is absent.
struct LengthMeasurements {
  std::optional<double> thigh, calf, upper_arm, lower_arm;
  std::optional<double> height;  ///< Of the person less the head.
};

/// Estimates part lengths from measured ones, known proportions and what was believed before.
/// Fig. 13.
class BodySizeNetwork {
 public:
  explicit BodySizeNetwork(const BodyProportions& proportions) : proportions_(proportions) {}

  /// Computes the mean of every length given the evidence: exact, since all nodes are linear and
  /// Gaussian. Eq. (22).
  /// @param sizes  what was believed before: the leaves of memory; takes the posterior means.
  /// @return  sum of the absolute changes of the five lengths [mm].
  double Update(const LengthMeasurements& measured, bool remember, BodySizes& sizes) const;

 private:
  BodyProportions proportions_;
};

}  // namespace mocap
