// §4: checks that the studio stayed still while its background was learned.
#pragma once

#include "core/image.h"

namespace mocap {

/// Largest share of the picture that may change in an empty room.
inline constexpr double kMostChange = 0.004;

/// Compares pictures with the first one, at every fourth pixel in both directions. Thread-bound.
class ChangeMeter {
 public:
  /// @return  the share of pixels that differ clearly, beyond noise and the flicker of lamps.
  double Measure(ImageView<const Bgr> image);

 private:
  Image<Bgr> first_;
};

}  // namespace mocap
