// §4: brightness and chromaticity distortion of every pixel, and of the windows around it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/closeup.h"

namespace mocap {

/// Runs down a picture and measures how it differs from what is expected.
///
/// The brightness distortion α is the scale that brings the expected colour closest to the pixel's;
/// the chromaticity distortion CD is the distance that is left, in standard deviations (Horprasert,
/// Harwood, Davis 1999). One pixel tells a grey trouser leg from a shadow no better than its noise
/// allows, so both are measured over square windows of two sizes too, together with how rough α is
/// there: a shadow dims a whole neighbourhood alike, or along a slope, and cloth has a grain of its
/// own. Thread-bound; reuses its memory.
class DistortionScan {
 public:
  static constexpr std::size_t kWindows = 2;
  /// Half the windows' sides, without the pixel in the middle.
  static constexpr std::array<int, kWindows> kRadii_px = {2, 3};

  /// Distortions of the windows around the pixels of one row.
  struct Windows {
    const float* alpha_shift = nullptr;   ///< Mean of α − 1.
    const float* cd_sq = nullptr;         ///< Squared length of the mean colour distance.
    const float* roughness_sq = nullptr;  ///< Variance of α about a plane, divided by a².
  };
  /// Results of one row; each pointer leads to one value a pixel, and is valid until the next row,
  /// for the pixels that are judged.
  struct Row {
    const float* alpha_shift = nullptr;    ///< α − 1; also for the pixels that are measured.
    const float* cd_sq = nullptr;          ///< CD².
    const float* alpha_weight = nullptr;   ///< 1/a: (α − 1)/a is normalised.
    const float* inverse_sigma = nullptr;  ///< 1/σ of green.
    std::array<Windows, kWindows> windows;
  };

  /// Starts at the top of a picture. All but `gain` are borrowed until the last row.
  /// @param expected  weighed for the pixels that are measured.
  /// @param gain      what each of the picture's channels is multiplied by.
  void Begin(const ExpectedPicture& expected, ImageView<const Bgr> image,
             const std::array<float, 3>& gain, const Closeup& closeup);

  /// Measures the next row. Beyond the picture's edge its outermost pixels are repeated.
  const Row& Next();

 private:
  static constexpr int kPad = kRadii_px.back();
  static constexpr int kLines = 2 * kPad + 1;
  static_assert(kPad <= Closeup::kMargin_px);

  // Sums along a row within the width of a window.
  struct Sums {
    std::vector<float> alpha, alpha_sq, moment;
    std::array<std::vector<float>, 3> cd;
  };
  // Pixels and their sums; pixels are padded by kPad on both sides.
  struct Line {
    std::vector<float> alpha_shift, cd_sq, alpha_weight, inverse_sigma;
    std::array<std::vector<float>, 3> cd;
    std::array<Sums, kWindows> sums;
  };
  struct Results {
    std::vector<float> alpha_shift, cd_sq, roughness_sq;
  };
  void Measure(int y, Line& line) const;
  void MeasureFrom(int y, int group, const Bgr* pixels, int count, Line& line) const;
  void RepeatEnds(Line& line) const;
  static void SumAlong(const PixelRun& run, Line& line);
  template <std::size_t window>
  void SumDown(int y, const PixelRun& run);

  const ExpectedPicture* expected_ = nullptr;
  const Closeup* closeup_ = nullptr;
  ImageView<const Bgr> image_;
  std::array<float, 3> gain_ = {1, 1, 1};
  int next_ = 0;
  int measured_ = 0;
  std::array<Line, kLines> lines_;
  std::array<Results, kWindows> results_;
  Row row_;
};

}  // namespace mocap
