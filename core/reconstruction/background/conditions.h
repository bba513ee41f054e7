// §4: changes that affect a whole picture of a camera.
#pragma once

#include <array>

namespace mocap {

/// Shift of a picture from its learned to its present position [pixels].
struct Displacement {
  float x_px = 0;
  float y_px = 0;
  friend bool operator==(const Displacement&, const Displacement&) = default;
};

/// How a picture as a whole differs from those of the empty studio. Lamps flicker, cameras adapt,
/// tripods are nudged, codecs blur.
struct Conditions {
  /// Factor for each channel that makes the picture look like the background.
  std::array<float, 3> gain = {1, 1, 1};
  /// Size of smooth deviations that were absent while learning [grey levels].
  float drift = 0;
  /// Additional shift of contours, compared with learning [pixels].
  float shift_px = 0;
  /// Position of the picture; the expected picture follows it.
  Displacement displacement;
};

}  // namespace mocap
