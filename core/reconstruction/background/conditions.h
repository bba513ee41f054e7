// §4: what changes for a camera's picture as a whole.
#pragma once

#include <array>

namespace mocap {

/// A shift of a picture, from where it was learned to where it lies [pixels].
struct Displacement {
  float x_px = 0;
  float y_px = 0;
  friend bool operator==(const Displacement&, const Displacement&) = default;
};

/// How a picture as a whole differs from those of the empty studio: lamps flicker, cameras adapt,
/// tripods get nudged, codecs blur.
struct Conditions {
  /// By what each channel must be multiplied to look like the background.
  std::array<float, 3> gain = {1, 1, 1};
  /// By how much smooth changes may lie off that were not there while learning [grey levels].
  float drift = 0;
  /// How much farther than while learning contours lie from where they belong [pixels].
  float shift_px = 0;
  /// Where the picture lies; what is expected follows it.
  Displacement displacement;
};

}  // namespace mocap
