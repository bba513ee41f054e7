// §4: brightness and chromaticity distortion of every pixel, and of the window around it.
#pragma once

#include <array>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/expected_picture.h"

namespace mocap {

/// Runs down a picture and measures how it differs from what is expected.
///
/// The brightness distortion α is the scale that brings the expected colour closest to the pixel's;
/// the chromaticity distortion CD is the distance that is left, in standard deviations (Horprasert,
/// Harwood, Davis 1999). One pixel tells a grey trouser leg from a shadow no better than its noise
/// allows, so both are measured over windows of 5 × 5 pixels too, together with how rough α is
/// there: a shadow dims a whole neighbourhood alike, or along a slope, and cloth has a grain of its
/// own.
/// Thread-bound; reuses its memory.
class DistortionScan {
 public:
  static constexpr int kRadius_px = 2;

  /// One row of results; each pointer leads to one value a pixel, and is valid until the next row.
  struct Row {
    const float* alpha_shift = nullptr;          ///< α − 1.
    const float* cd_sq = nullptr;                ///< CD², in variances.
    const float* window_alpha_shift = nullptr;   ///< Mean of α − 1 over the window.
    const float* window_cd_sq = nullptr;         ///< Squared length of the mean colour distance.
    const float* window_roughness_sq = nullptr;  ///< Variance of α about a plane, over its own.
    const float* inverse_alpha_variation = nullptr;  ///< 1/a: (α − 1)/a is normalised.
  };

  /// Starts at the top of a picture. Both are borrowed until the last row.
  void Begin(const ExpectedPicture& expected, ImageView<const Bgr> image, float gain);

  /// Measures the next row. Beyond the picture's edge its outermost pixels are repeated.
  const Row& Next();

 private:
  static constexpr int kSide = 2 * kRadius_px + 1;

  // Row by row results, and their sums along the row within the window's width.
  struct Line {
    std::vector<float> alpha_shift, cd_sq;
    std::array<std::vector<float>, 3> cd;
    std::vector<float> sum, sum_sq, slope;
    std::array<std::vector<float>, 3> cd_sum;
  };
  void MeasurePixels(int y, Line& line) const;
  void SumAlong(Line& line) const;
  const Line& LineAt(int y) const;

  const ExpectedPicture* expected_ = nullptr;
  ImageView<const Bgr> image_;
  float gain_ = 1;
  int next_ = 0;
  int measured_ = 0;
  std::array<Line, kSide> lines_;
  std::array<std::vector<float>, 3> color_;
  std::vector<float> window_alpha_shift_, window_cd_sq_, window_roughness_sq_;
  Row row_;
};

}  // namespace mocap
