// §4: background, shadow, highlight, foreground.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/reconstruction/background/expected_picture.h"
#include "core/reconstruction/silhouette/distortion_scan.h"
#include "core/reconstruction/silhouette/distortion_thresholds.h"
#include "core/reconstruction/silhouette/region_of_interest.h"
#include "core/reconstruction/silhouette/silhouette.h"

namespace mocap {

/// The four classes of Horprasert, Harwood, Davis 1999.
enum class PixelClass : std::uint8_t { kBackground, kShadow, kHighlight, kForeground };

/// Decides what each pixel of a picture shows.
///
/// A pixel is background, shadow or highlight when it could be so by itself and lies in some
/// window, of one size or the other, that could be so as a whole; otherwise it is foreground. What
/// is not looked at closely is background.
/// Thread-bound; reuses its memory.
class PixelClassifier {
 public:
  /// Factors by which thresholds must be exceeded. They stand for what an empty studio does not
  /// show: tints of shadows, and the noise that a codec lets through only where something moves.
  /// Measured on takes with true masks; a tenth more or less serves as well.
  static constexpr std::array<float, kWindows> kWindowMargins = {1.1f, 1.35f};
  /// One pixel alone must differ more, for there are many of them.
  static constexpr float kPixelMargin = 1.6f;

  /// @param darkest_shadow  the brightness distortion below which nothing is a shadow.
  PixelClassifier(const DistortionThresholds& thresholds, float darkest_shadow);

  /// Classifies a picture; the results hold until the next one, as long as `expected` does.
  /// @param expected  weighed under these conditions for the pixels that are measured.
  void Classify(const ExpectedPicture& expected, ImageView<const Bgr> image,
                const Conditions& conditions, const RegionOfInterest& roi);

  /// Gives the class of a pixel that was measured.
  PixelClass ClassOf(int x, int y) const;
  /// Where the class is foreground, within the region of interest's frame.
  const Silhouette& foreground() const { return foreground_; }
  /// Where background would be as rare as the training frames allow, but not clearly beyond that:
  /// within the region of interest's frame.
  const Silhouette& doubtful() const { return doubtful_; }
  /// Where it is darker than the empty studio by more than noise, be it a shadow or not: within the
  /// region of interest's frame.
  const Silhouette& dark() const { return dark_; }
  /// α − 1 of every pixel that is measured.
  ImageView<const float> alpha_shift() const { return scan_.alpha_shift(); }

 private:
  void Resize(const RegionOfInterest& roi);

  DistortionThresholds thresholds_;
  float darkest_shadow_;
  const ExpectedPicture* expected_ = nullptr;
  PixelBox frame_;
  DistortionScan scan_;
  Silhouette clear_pixels_;
  std::array<Silhouette, kWindows> clear_windows_, doubtful_windows_, eroded_;
  Silhouette foreground_, doubtful_, dark_;
};

}  // namespace mocap
