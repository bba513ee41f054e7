// The noise of keypoints about the body model's points.
#pragma once

#include <cmath>

#include "core/body/landmarks.h"

namespace mocap {

/// Keypoints of one person in one picture.
struct KeypointNoise {
  double freedom = 2;      ///< Degrees of freedom of Student's t, in the two directions across.
  double independent = 9;  ///< The points of a view count as so many independent ones.
  /// Area about its right place in which a point of a wrong view lies [mm²].
  double region_mm2 = 300.0 * 300.0;
  double exchanged = 0.05;  ///< Probability of a view with left and right exchanged.
  double elsewhere = 0.1;   ///< Probability of a view of something else.
  /// Errors of one camera's views last: they correlate by exp(-t / lasts_s).
  double lasts_s = 2.4;

  double Right() const { return 1 - exchanged - elsewhere; }
};
inline constexpr KeypointNoise kKeypointNoise{};

/// How much a view counts that follows another one of the same camera after a time: the information
/// that it adds if errors are a first-order autoregressive process.
inline double WorthOfNextView(double after_s) {
  return std::tanh(after_s / (2 * kKeypointNoise.lasts_s));
}

/// Scale of Student's t [mm].
/// @param score  as in Keypoint.
double KeypointScale_mm(Landmark landmark, double score);

}  // namespace mocap
