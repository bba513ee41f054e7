// §4: the empty studio as a camera would see it at this moment.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/kernels/expected_pixels.h"
#include "core/reconstruction/background/conditions.h"

namespace mocap {

/// Variance where nothing is known: any colour is accepted.
inline constexpr float kUnknownVariance = 1e8f;

using kernels::WeighedPixels;

/// The background's colours and their variation per pixel, in planes of rows without gaps.
///
/// Channels are blue, green, red. Horprasert, Harwood, Davis 1999; the variations of the brightness
/// and the chromaticity distortion, a and b, are those that σ causes.
struct ExpectedPicture {
  /// Near black, a colour has no direction.
  static constexpr float kDarkestMean = kernels::kDarkestMean;

  ExpectedPicture() = default;
  ExpectedPicture(int picture_width, int picture_height);

  /// Writes the appearance of pixel `i`, which must then be weighed.
  /// @param color, sigma  expected colour and its standard deviation [grey levels].
  void SetPixel(std::size_t i, const std::array<float, 3>& color,
                const std::array<float, 3>& sigma);

  /// Computes the weights of pixels [begin, end) of a row, and of the others in their groups.
  /// @param shift_px  additional shift of contours, compared with learning.
  void Weigh(float shift_px, int y, int begin, int end);

  /// Copies pixels [begin, end) of a row from another picture, displaced by less than its size.
  /// They must then be weighed.
  void Displace(const ExpectedPicture& from, const Displacement& displacement, int y, int begin,
                int end);

  int width = 0;
  int height = 0;
  std::array<std::vector<float>, 3> mean;      ///< E, at least kDarkestMean [grey levels].
  std::array<std::vector<float>, 3> variance;  ///< σ² [grey levels²].
  std::vector<std::uint8_t> slope;             ///< Of the brightness [grey levels per pixel].

  /// Returns one row of a group, from column `group` · 16 and row `y` of the picture. The next
  /// group to the right follows after `height` rows: people are taller than wide, and contiguous
  /// memory is read fastest.
  const WeighedPixels* Group(int group, int y) const {
    return &weighed_[static_cast<std::size_t>(group) * height + y];
  }
  // Single pixels as they were weighed.
  float MeanAt(int x, int y, int channel) const {
    return GroupAt(x, y).mean[channel][x % WeighedPixels::kPixels] * WeighedPixels::kMeanUnit;
  }
  float InverseSigmaAt(int x, int y, int channel) const {
    return GroupAt(x, y).inverse_sigma[channel][x % WeighedPixels::kPixels] *
           WeighedPixels::kInverseSigmaUnit;
  }
  float AlphaWeightAt(int x, int y) const {
    return GroupAt(x, y).alpha_weight[x % WeighedPixels::kPixels] * WeighedPixels::kAlphaWeightUnit;
  }

 private:
  const WeighedPixels& GroupAt(int x, int y) const { return *Group(x / WeighedPixels::kPixels, y); }

  std::vector<WeighedPixels> weighed_;
};

}  // namespace mocap
