// §4: what a camera would see of the empty studio at this moment.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/image.h"

namespace mocap {

/// The background's colours and their variation, pixel by pixel, in planes of rows without gaps.
///
/// Channels are blue, green, red. Horprasert, Harwood, Davis 1999, with E/σ and 1/σ in place of E
/// and σ; the variation of the chromaticity distortion, b, is part of σ.
struct ExpectedPicture {
  ExpectedPicture() = default;
  ExpectedPicture(int picture_width, int picture_height);

  /// Writes what pixel `i` looks like.
  /// @param mean, sigma      expected colour and its standard deviation [grey levels].
  /// @param alpha_variation  standard deviation of the brightness distortion as it was measured, or
  /// 0: it is never taken for less than what `sigma` causes.
  void SetPixel(std::size_t i, const std::array<float, 3>& mean, const std::array<float, 3>& sigma,
                float alpha_variation);

  float MeanOf(std::size_t i, int channel) const {
    return scaled_mean[channel][i] / inverse_sigma[channel][i];
  }

  int width = 0;
  int height = 0;
  std::array<std::vector<float>, 3> scaled_mean;    ///< E/σ.
  std::array<std::vector<float>, 3> inverse_sigma;  ///< 1/σ [1/grey level].
  std::vector<float> inverse_alpha_variation;       ///< 1/a.
};

/// Measures by what factor a picture must be multiplied to be as bright as the background: lamps
/// flicker and cameras adapt. Whatever covers less than half of what is known of the picture does
/// not disturb it.
///
/// @param scratch  memory to work in, kept by the caller.
float MeasureGain(const ExpectedPicture& expected, ImageView<const Bgr> image,
                  std::vector<float>& scratch);

}  // namespace mocap
