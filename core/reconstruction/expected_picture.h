// §4: what a camera would see of the empty studio at this moment.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mocap {

/// The background's colours and their variation, pixel by pixel, in planes of rows without gaps.
///
/// Channels are blue, green, red. Horprasert, Harwood, Davis 1999; the variation of the
/// chromaticity distortion, b, is part of σ.
struct ExpectedPicture {
  /// A colour has a direction only away from black.
  static constexpr float kDarkestMean = 1;

  ExpectedPicture() = default;
  ExpectedPicture(int picture_width, int picture_height);

  /// Writes what pixel `i` looks like.
  /// @param color, sigma     expected colour and its standard deviation [grey levels].
  /// @param alpha_variation  standard deviation of the brightness distortion as it was measured, or
  /// 0: it is never taken for less than what `sigma` causes.
  void SetPixel(std::size_t i, const std::array<float, 3>& color, const std::array<float, 3>& sigma,
                float alpha_variation);

  int width = 0;
  int height = 0;
  std::array<std::vector<float>, 3> mean;      ///< E, at least kDarkestMean [grey levels].
  std::array<std::vector<float>, 3> variance;  ///< σ² [grey levels²].
  std::vector<float> alpha_weight;             ///< 1/a as measured; much where it was not.
  std::vector<std::uint8_t> slope;             ///< Of the brightness [grey levels per pixel].
};

}  // namespace mocap
