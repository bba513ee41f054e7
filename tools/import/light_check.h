// Whether a camera's exposure and white balance were fixed.
#pragma once

#include "core/image.h"
#include "core/reconstruction/empty_room/steady_picture.h"

namespace mocap {

/// Changes of a whole picture, as factors of grey levels.
struct LightRange {
  double darkest = 1, brightest = 1;  ///< Compared with the first picture.
  double bluest = 1, reddest = 1;     ///< Red over blue, likewise.

  double BrightnessChange() const { return brightest / darkest - 1; }
  double ColorChange() const { return reddest / bluest - 1; }
  /// The smallest step of automatic exposures is a sixth of a stop, which are 5 % of a grey level
  /// at a gamma of 2.2. Lamps flicker by less.
  bool IsExposureFixed() const { return BrightnessChange() < 0.05; }
  /// Red over blue changes by as much between 5000 K and 5200 K (Planck's law, at the same gamma).
  bool IsWhiteFixed() const { return ColorChange() < 0.03; }
};

/// Compares pictures of a fixed camera with its first one. People may move in less than half of
/// the picture. Thread-bound.
class LightMeter {
 public:
  /// @pre  all pictures have one size.
  void Add(ImageView<const Bgr> picture);
  const LightRange& range() const { return range_; }

 private:
  Image<Bgr> first_;
  LightRange range_;
};

}  // namespace mocap
