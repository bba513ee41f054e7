// §4: whether the studio stayed still while its background was learned.
#pragma once

#include "core/image.h"

namespace mocap {

/// How much of the picture may change, at the most, in a room where nobody is.
inline constexpr double kMostChange = 0.004;

/// Holds pictures against the first one, at every fourth pixel each way. Thread-bound.
class ChangeMeter {
 public:
  /// @return  the share of the picture that differs clearly, beyond noise and the flicker of lamps.
  double Measure(ImageView<const Bgr> image);

 private:
  Image<Bgr> first_;
};

}  // namespace mocap
