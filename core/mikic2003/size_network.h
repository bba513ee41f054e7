// §7.2: the Bayesian network of body part lengths. Fig. 13, Table 3.
#pragma once

#include <optional>

#include "core/body/body_sizes.h"
#include "core/mikic2003/limbs.h"

namespace mocap::mikic2003 {

/// The leaves of Fig. 13 that a frame shows; lengths [mm]. What was not measured is absent.
struct LengthMeasurements {
  std::optional<double> thigh, calf, upper_arm, lower_arm;  ///< Thm, Cm, UAm, LAm.
  double height = 0;                                        ///< Of the person, less the head.
};

/// Takes the lengths of the limbs' parts from measured points: the mean of left and right.
LengthMeasurements MeasureLengths(const MeasuredPoints& points, double height_less_head_mm);

/// Estimates lengths from what is measured, what was believed, and known proportions.
class SizeNetwork {
 public:
  /// Computes the mean of every length given all leaves; exact, since all nodes are linear and
  /// Gaussian. Eq. (22).
  ///
  /// Where the measured torso, thigh and calf add up to clearly more than the height, that sum is
  /// the height: the person does not stand upright. ("Significantly" is 10 %.)
  /// @param sizes  takes the new lengths.
  /// @return  the sum of the lengths' changes [mm].
  double Update(LengthMeasurements measured, BodySizes& sizes);

 private:
  bool remembers_ = false;  ///< Thm0, Cm0, UAm0 and LAm0 are known from the second update on.
};

}  // namespace mocap::mikic2003
