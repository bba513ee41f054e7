// §4: what a camera would see of the empty studio at this moment.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/reconstruction/background/conditions.h"

namespace mocap {

/// The variance where nothing is known: anything goes.
inline constexpr float kUnknownVariance = 1e8f;

/// The background model of several adjacent pixels, packed for the cache.
struct WeighedPixels {
  static constexpr int kPixels = 16;
  using Column = std::array<std::uint16_t, kPixels>;
  // Units of the columns.
  static constexpr float kMeanUnit = 1.0f / 256;
  static constexpr float kInverseSigmaUnit = 1.0f / 65536;
  static constexpr float kAlphaWeightUnit = 1.0f / 128;

  std::array<Column, 3> mean;           ///< E.
  std::array<Column, 3> inverse_sigma;  ///< 1/σ; σ is wider where contours shift.
  Column alpha_weight;                  ///< 1/a.
};

/// The background's colours and their variation, pixel by pixel, in planes of rows without gaps.
///
/// Channels are blue, green, red. Horprasert, Harwood, Davis 1999; the variation of the
/// chromaticity distortion, b, is part of σ.
struct ExpectedPicture {
  /// A colour has a direction only away from black.
  static constexpr float kDarkestMean = 1;

  ExpectedPicture() = default;
  ExpectedPicture(int picture_width, int picture_height);

  /// Writes what pixel `i` looks like; to be weighed.
  /// @param color, sigma     expected colour and its standard deviation [grey levels].
  /// @param alpha_variation  standard deviation of the brightness distortion as it was measured, or
  /// 0: it is never taken for less than what `sigma` causes.
  void SetPixel(std::size_t i, const std::array<float, 3>& color, const std::array<float, 3>& sigma,
                float alpha_variation);

  /// Works out the weights of pixels [begin, end) of a row, and of those in the same groups.
  /// @param shift_px  how much farther than while learning contours lie from where they belong.
  void Weigh(float shift_px, int y, int begin, int end);

  /// Writes pixels [begin, end) of a row: another picture's, displaced by less than its size. They
  /// are to be weighed.
  void Displace(const ExpectedPicture& from, const Displacement& displacement, int y, int begin,
                int end);

  int width = 0;
  int height = 0;
  std::array<std::vector<float>, 3> mean;      ///< E, at least kDarkestMean [grey levels].
  std::array<std::vector<float>, 3> variance;  ///< σ² [grey levels²].
  std::vector<float> alpha_limit;              ///< 1/a as measured; much where it was not.
  std::vector<std::uint8_t> slope;             ///< Of the brightness [grey levels per pixel].

  /// Leads to a group of pixels, the first of which is the picture's. The next to the right is
  /// `height` groups on: a person is higher than wide, and memory is read best in one piece.
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
