// How well the tangent planes of two cameras agree, by the offset between their clocks.
#pragma once

#include <optional>
#include <vector>

#include "tools/import/tangent_track.h"

namespace mocap {

/// Agreement at offsets that are whole steps, beyond what unrelated moments have in the mean.
struct AgreementCurve {
  double begin_s = 0;  ///< How far the first camera is ahead at gains[0].
  double step_s = 0;
  std::vector<float> gains;

  /// Gain at an offset, at the nearest step; 0 outside.
  double At(double ahead_s) const;
};

/// Compares all offsets at which at least `least_s` are common.
/// @param tolerance_px  differences from here on are none of the same moment.
AgreementCurve CurveOf(const TangentPair& pair, double step_s, double least_s, double tolerance_px);

/// An offset between frames.
struct FineOffset {
  double ahead_s = 0;
  double sigma_s = 0;
};

/// Refines an offset. Each side's constant error, and its scatter, are estimated meanwhile.
/// @param reach_s  how far the offset may be from `ahead_s`.
/// @return  empty if the tracks show too little, or the best offset is out of reach.
std::optional<FineOffset> RefineOffset(const TangentPair& pair, double ahead_s, double step_s,
                                       double reach_s, double tolerance_px);

}  // namespace mocap
