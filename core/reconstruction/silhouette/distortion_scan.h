// §4: brightness and chromaticity distortion of every pixel, and of the windows around it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/kernels/windows.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/region_of_interest.h"

namespace mocap {

/// Scans a picture from top to bottom and measures its deviation from the expected one.
///
/// The brightness distortion α is the scale that brings the expected colour closest to the pixel's.
/// The chromaticity distortion CD is the remaining distance, in standard deviations (Horprasert,
/// Harwood, Davis 1999). A single pixel distinguishes a grey trouser leg from a shadow no better
/// than its noise allows. So both are also measured over square windows of two sizes, together with
/// the roughness of α. A shadow dims a neighbourhood evenly or along a slope; cloth has a texture.
/// Thread-bound; reuses its memory.
class DistortionScan {
 public:
  /// One row. `alpha_shift` is also valid for all measured pixels.
  using Row = kernels::DistortionRow;
  /// Two adjacent rows. The second may lie below the picture; its values mean nothing then. Valid
  /// until the next two, for judged pixels. Values of other pixels in the same block mean nothing
  /// either.
  using RowPair = kernels::DistortionRowPair;

  /// Starts at the top of a picture. All arguments but `gain` are borrowed until the last rows.
  /// @param expected  weighed for the measured pixels.
  /// @param gain      factor for each of the picture's channels.
  void Begin(const ExpectedPicture& expected, ImageView<const Bgr> image,
             const std::array<float, 3>& gain, const RegionOfInterest& roi);

  /// Measures the next two rows. The outermost pixels are repeated beyond the picture's edge.
  const RowPair& Next();

  /// α − 1 of the measured pixels.
  ImageView<const float> alpha_shift() const {
    return {alpha_shift_.row(0) + kPad, alpha_shift_.width() - kBeside, alpha_shift_.height(),
            alpha_shift_.width()};
  }

 private:
  static constexpr int kPad = kernels::kBlock_px;  // On both sides of the picture.
  static constexpr int kBeside = 2 * kPad + WeighedPixels::kPixels;  // Whole groups are measured.
  static_assert(kernels::kLargestRadius_px <= RegionOfInterest::kTile_px &&
                kernels::kLargestRadius_px <= kPad);
  // Number of rows that are measured at a time: they have the same runs.
  static constexpr int kBand_px = 4;
  static_assert(RegionOfInterest::kTile_px % kBand_px == 0 && kernels::kSumLines % kBand_px == 0 &&
                kernels::kSumLines >= kernels::kPairLines + kBand_px - 1);

  // The last lines, padded by kPad.
  struct Lines {
    Image<float> cd_sq, alpha_weight, inverse_sigma;
    std::array<Image<float>, 3> cd;
  };
  void MeasureBand(int y);
  void Measure(ImageView<const Bgr> pixels, int y, int group);
  void MeasureLast(int y, int rows);
  void RepeatEnds(int y);
  void SumAlong(int y, int rows, const PixelRun& run);

  const ExpectedPicture* expected_ = nullptr;
  const RegionOfInterest* roi_ = nullptr;
  ImageView<const Bgr> image_;
  std::array<float, 3> gain_ = {1, 1, 1};
  int next_ = 0;
  int measured_ = 0;
  Image<float> alpha_shift_;  // Padded by kPad.
  Lines lines_;
  Image<Bgr> last_;  // A band of the group in which the picture ends.
  std::vector<kernels::BlockSums> sums_;
  RowPair pair_;
};

}  // namespace mocap
