// §7.2: the Bayesian network of body part lengths. Fig. 13, Table 3.
#pragma once

#include <optional>

#include "core/body/body_sizes.h"
#include "core/mikic2003/limbs.h"

namespace mocap::mikic2003 {

/// The leaves of Fig. 13 for one frame; lengths [mm]. Lengths that were not measured are absent.
struct LengthMeasurements {
  std::optional<double> thigh, calf, upper_arm, lower_arm;  ///< Thm, Cm, UAm, LAm.
  double height = 0;                                        ///< Of the person, without the head.
};

/// Computes the lengths of the limbs' parts from measured points, as means of left and right.
LengthMeasurements MeasureLengths(const MeasuredPoints& points, double height_less_head_mm);

/// Estimates lengths from measurements, earlier estimates and known proportions.
class SizeNetwork {
 public:
  /// Computes the mean of every length given all leaves. It is exact, because all nodes are linear
  /// and Gaussian. Eq. (22).
  ///
  /// If the torso, the measured thigh and the measured calf are together clearly longer than the
  /// height, their sum replaces the height: the person does not stand upright. ("Significantly" is
  /// 10 %.)
  /// @param sizes  gets the new lengths.
  /// @return  the amount of the sum of all changes, in which growth and shrinking cancel [mm].
  double Update(LengthMeasurements measured, BodySizes& sizes);

 private:
  bool remembers_ = false;  ///< Thm0, Cm0, UAm0 and LAm0 are known from the second update on.
};

}  // namespace mocap::mikic2003
