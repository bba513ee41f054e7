// §4: brightness and chromaticity distortion of pixels (Horprasert, Harwood, Davis 1999).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/image.h"

namespace mocap::kernels {

/// The background model of several adjacent pixels, packed for the cache.
struct WeighedPixels {
  static constexpr int kPixels = 16;
  using Column = std::array<std::uint16_t, kPixels>;
  // Units of the columns.
  static constexpr float kMeanUnit = 1.0f / 256;
  static constexpr float kInverseSigmaUnit = 1.0f / 65536;
  static constexpr float kAlphaWeightUnit = 1.0f / 128;

  std::array<Column, 3> mean;           ///< E.
  std::array<Column, 3> inverse_sigma;  ///< 1/σ; σ is larger where contours shift.
  Column alpha_weight;                  ///< 1/a.
};

/// Results for a band of pixels. Each pointer has one value per pixel, in rows `row_step` numbers
/// apart.
struct DistortionRows {
  float* alpha_shift;        ///< α − 1.
  std::array<float*, 3> cd;  ///< The remaining distance [σ], per channel.
  float* cd_sq;              ///< Its squared length.
  float* alpha_weight;       ///< 1/a.
  float* inverse_sigma;      ///< 1/σ of green.
  int row_step;
};

/// Measures a band of pixels, which is prefetched for the next band. α is the scale that brings the
/// expected colour closest to the pixel's.
/// @param groups  first expected group of the first row. Those of further rows follow directly, and
///                the next to the right after `group_step`.
/// @param band    a multiple of WeighedPixels::kPixels wide.
/// @param gain    factor for each of the picture's channels.
/// @param ahead   number of rows from here to those that are needed next.
void MeasureDistortions(const WeighedPixels* groups, int group_step, ImageView<const Bgr> band,
                        const std::array<float, 3>& gain, int ahead, const DistortionRows& to);

}  // namespace mocap::kernels
