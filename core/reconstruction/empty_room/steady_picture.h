// Beyond the paper: pictures in which an unchanged wall stays the same, and a soft shadow does not.
#pragma once

#include <array>

#include "core/image.h"

namespace mocap {

/// Factor of each channel.
using LightGain = std::array<double, 3>;

/// Changes a picture's light.
Image<Bgr> InLight(const Image<Bgr>& picture, const LightGain& gain);

/// Measures the light of a picture, compared with another one of the same size. Less than half of
/// it may show something else.
LightGain LightBetween(const Image<Bgr>& before, const Image<Bgr>& now);

/// Smooth() mixes pixels up to this far apart in each direction.
inline constexpr int kSmoothed_px = 2;

/// Returns the means around each pixel: noise of single pixels would hide soft shadows.
Image<Bgr> Smooth(ImageView<const Bgr> picture);

/// A smooth picture in the light of the first one.
struct SteadyPicture {
  Image<Bgr> color;
  LightGain light;  ///< Of the picture itself, compared with the first one.
};

/// Removes noise and the flicker of lamps from the pictures of a camera. Thread-bound.
class PictureSteadier {
 public:
  /// @pre  all pictures have one size.
  SteadyPicture Steady(ImageView<const Bgr> picture);

 private:
  Image<Bgr> first_;
};

}  // namespace mocap
